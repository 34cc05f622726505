// Several configurations that solve one problem: one after the other, or all at once.

class Solutions {
  constructor(app, solutions, draw) {
    this.app = app;
    this.solutions = solutions;
    this.number = 0;
    const get = id => document.getElementById(id);
    get("solutions").hidden = false;
    get("former").onclick = () => this.choose(this.number - 1);
    get("next").onclick = () => this.choose(this.number + 1);
    const overlay = get("overlay");
    this.ghosts = solutions.map(({ q }) => {
      const ghost = draw(0.25);
      ghost.show(q);
      ghost.group.visible = false;
      return ghost;
    });
    overlay.onclick = () => {
      overlay.setAttribute("aria-pressed", String(overlay.getAttribute("aria-pressed") !== "true"));
      this.show();
    };
    this.choose(0);
  }

  choose(number) {
    const count = this.solutions.length;
    this.number = (number + count) % count;
    this.app.change(this.solutions[this.number].q);
    this.show();
  }

  show() {
    const { label: name } = this.solutions[this.number];
    const all = document.getElementById("overlay").getAttribute("aria-pressed") === "true";
    this.ghosts.forEach((ghost, i) => (ghost.group.visible = all && i !== this.number));
    const which = `${this.number + 1}/${this.solutions.length}`;
    document.getElementById("which").textContent = name ? `${which}  ${name}` : which;
    this.app.stage.changed();
  }
}
