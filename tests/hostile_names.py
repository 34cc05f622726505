"""Robot files whose names want to do something: end a string, be markup, move the cursor, turn the text round."""

from xml.sax.saxutils import quoteattr

NAMES = {
    "docstring": '"""\nimport os\nos.mkdir("ran")\n"""',
    "docstring with spaces": '""";__import__("os").mkdir("ran");"""',
    "single quotes": "'''+__import__('os').mkdir('ran')+'''",
    "backslash at the end": "arm\\",
    "windows path": r"C:\users\arm",
    "unicode escape": r"\N{DIGIT ONE} \x41 \u0041",
    "closing tag": "[/x]",
    "markup": "[bold red]loud[/bold red]",
    "emoji": ":smile:",
    "link": "[link=file:///etc]x[/link]",
    "line break": "arm\nerror: all is well",
    "carriage return": "arm\rerror",
    "tabulator": "a\tb",
    "c1": "a\x9b31mred",
    "osc": "\x9d0;title\x9c",
    "bidi": "arm\u202egnp.exe",
    "isolate": "\u2066a\u2069",
    "line separator": "a\u2028import os",
    "zero width": "q\u200b1",
    "tag characters": "a\U000e0041",
    "script": "</script><script>document.title='ran'</script>",
    "image": "<img src=x onerror=\"document.title='ran'\">",
    "entity": "&amp;&lt;b&gt;",
    "template": "$title $$ {0} {name} %s %(x)s",
    "latex": r"$\input{/etc/passwd}$ \end{document} $$ _{^",
    "path": "../../../x",
    "absolute path": "/etc/x",
    "option": "--help",
    "chinese": "机器人",
    "arabic": "ذراع",
    "accents": "Körper",
    "long": "a" * 2000,
}


def arm_text(name):
    """The URDF of a planar 2R whose robot, links and joints have the name in theirs."""
    called = {key: quoteattr(key + name) for key in ("base", "upper", "fore", "q1 ", "q2 ", "hand ", "tool")}
    joints = []
    for joint, parent, child in (("q1 ", "base", "upper"), ("q2 ", "upper", "fore")):
        joints.append(
            f"<joint name={called[joint]} type='revolute'><origin xyz='{0.5 if joint == 'q2 ' else 0} 0 0'/>"
            f"<parent link={called[parent]}/><child link={called[child]}/><axis xyz='0 0 1'/>"
            "<limit lower='-3' upper='3' velocity='1' effort='0.001'/></joint>"
        )
    links = "".join(f"<link name={called[link]}/>" for link in ("base", "upper", "fore", "tool"))
    hand = (
        f"<joint name={called['hand ']} type='fixed'><origin xyz='0.5 0 0'/><parent link={called['fore']}/>"
        f"<child link={called['tool']}/></joint>"
    )
    box = "<visual><geometry><box size='1 1 1'/></geometry></visual>"
    links = links.replace("/>", f">{box}</link>", 1)
    return f"<robot name={quoteattr(name)}>{links}{''.join(joints)}{hand}</robot>"


def arm_file(folder, name):
    """The file of such a robot."""
    path = folder / "arm.urdf"
    path.write_text(arm_text(name), encoding="utf-8")
    return path
