// The scripts of a page stand one after the other in one <script>: what one declares, the others use.

import { readdirSync, readFileSync } from "node:fs";
import js from "@eslint/js";
import globals from "globals";

const folder = new URL("robotics1/viewer/page/", import.meta.url);
const scripts = readdirSync(folder).filter(name => name.endsWith(".js"));
const declared = scripts.flatMap(name => {
  const text = readFileSync(new URL(name, folder), "utf8");
  return [...text.matchAll(/^(?:const|class|(?:async )?function) (\w+)/gm)].map(found => found[1]);
});

export default [
  js.configs.recommended,
  {
    files: ["robotics1/viewer/page/*.js"],
    languageOptions: {
      sourceType: "script",
      globals: { ...globals.browser, MeshCat: "readonly", ...Object.fromEntries(declared.map(name => [name, "readonly"])) },
    },
    linterOptions: { reportUnusedDisableDirectives: "error" },
    rules: {
      "no-redeclare": ["error", { builtinGlobals: false }],
      "no-unused-vars": ["error", { vars: "local", args: "after-used" }],
      "no-var": "error",
      "prefer-const": "error",
      eqeqeq: "error",
      "no-eval": "error",
      "no-implied-eval": "error",
      "no-shadow": "error",
      complexity: ["error", 12],
      "max-len": ["error", 120],
      "max-lines": ["error", 300],
      "max-lines-per-function": ["error", 50],
    },
  },
];
