#!/usr/bin/env python3
"""Makes man pages and the completion of bash, zsh and fish from what programs say by --help, so that these cannot drift from it.

usage: manual.py OUT PINTLE [OTHER_PROGRAM …]        OUT gets man/*.1, bash/pintle, zsh/_pintle, fish/pintle.fish
"""

import re
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Option:
    names: list  # "-o", "--out"; of an operand its one name
    value: str  # "DIR"; empty: a flag
    help: str
    many: bool = False

    @property
    def flags(self):
        return "|".join(self.names)


@dataclass
class Command:
    name: str
    about: str
    operands: list = field(default_factory=list)
    options: list = field(default_factory=list)
    commands: list = field(default_factory=list)  # of the program: name and what it does
    footer: str = ""


def text_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def is_there(pintle, command):
    """`film`, `view`, `fmu` and `hdf5` are programs of their own, which a build may lack."""
    return subprocess.run([pintle, command, "--help"], capture_output=True).returncode == 0


def read_entry(heading, words):
    """ "-o,--out DIR" and what its help says"""
    names, _, value = heading.partition(" ")
    value = re.sub(r"\b(REQUIRED|Excludes: \S+|Needs: \S+)", "", value).strip()
    many = value.endswith("...")
    value = value.removesuffix("...").partition(":")[0].strip()  # without the range that CLI11 adds
    return Option(names.split(","), value, words, many)


def read_help(name, text):
    """What CLI11 prints: a description, the usage, sections of entries, a footer."""
    about, _, rest = text.partition("Usage:")
    command, section, entries = Command(name, " ".join(about.split())), None, []
    lines = rest.splitlines()[1:]
    for number, line in enumerate(lines):
        if line in ("Positionals:", "Options:", "Subcommands:"):
            section = line[:-1]
        elif section and re.match(r"  \S", line):
            parts = re.match(r"  (\S.*?)(?:\s{2,}(\S.*))?$", line)
            if len(line) > 30 and line[29] == " " and line[30] != " ":  # the help begins in column 30
                parts = re.match(r"  (.{27})\s*(.*)$", line)
            entries.append([section, parts[1].strip(), parts[2] or ""])
        elif section and line.startswith("   "):
            entries[-1][2] += " " + line.strip()
        elif section and line and not line.startswith(" "):
            command.footer = "\n".join(lines[number:]).strip()
            break
    for section, heading, words in entries:
        if section == "Subcommands":
            command.commands.append((heading, words))
        else:
            (command.operands if section == "Positionals" else command.options).append(read_entry(heading, words.strip()))
    return command


# Man pages -----------------------------------------------------------------------------------------------------------------------------


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"(?m)^([.'])", r"\\&\1", text)


def verbatim(text):
    return f".nf\n{roff(text)}\n.fi\n"


def man_page(command, version, siblings):
    title = command.name.replace(" ", "-")
    operands = " ".join(f"\\fI{roff(o.value or o.names[0])}\\fR" + (" ..." if o.many else "") for o in command.operands)
    if command.commands:
        operands = "\\fICOMMAND\\fR ..."
    out = f'.TH "{title.upper()}" 1 "" "pintle {version}" "User Commands"\n'
    about = command.about if len(command.about) < 90 else command.about.split(":")[0].split(";")[0]
    out += f".SH NAME\n{roff(title)} \\- {roff(about)}\n.SH SYNOPSIS\n\\fB{roff(command.name)}\\fR [\\fIOPTIONS\\fR] {operands}\n"
    out += f".SH DESCRIPTION\n{roff(command.about)}\n"
    if command.commands:
        out += ".SH COMMANDS\n" + "".join(f".TP\n\\fB{roff(n)}\\fR\n{roff(w)} (\\fBpintle\\-{roff(n)}\\fR(1))\n" for n, w in command.commands)
    for o in command.operands:
        out += f".TP\n\\fI{roff(o.value or o.names[0])}\\fR\n{roff(o.help)}\n"
    out += ".SH OPTIONS\n"
    for o in command.options:
        names = ", ".join(f"\\fB{roff(n)}\\fR" for n in o.names)
        out += f".TP\n{names}" + (f" \\fI{roff(o.value)}\\fR" if o.value else "") + f"\n{roff(o.help)}\n"
    if command.footer:
        out += ".SH NOTES\n" + verbatim(command.footer)
    others = ", ".join(f"\\fB{roff(s)}\\fR(1)" for s in siblings if s != title)
    return out + f".SH SEE ALSO\n{others}\n"


# Completion ----------------------------------------------------------------------------------------------------------------------------


def kind(value):
    """What stands for a value on the command line: a glob of files, "/" for folders, or nothing that a shell could know."""
    if value == "DIR":
        return "/"
    if value.startswith(("SCENE", "FILE")):
        ending = value.partition(".")[2]
        return {"yaml": "*.@(yaml|yml|json)", "": "*"}.get(ending, f"*.{ending}")
    return ""


def bash(program, commands):
    cases, operands = "", ""
    for c in commands:
        flags = " ".join(n for o in c.options for n in o.names)
        operand = kind(c.operands[0].value) if c.operands else ""
        operands += f"    {c.name.split()[1]}) options='{flags}' operand='{operand}' ;;\n"
    values = {}
    for c in [program, *commands]:
        for o in c.options:
            if o.value:
                values.setdefault(kind(o.value), set()).update(o.names)
    for what, names in sorted(values.items()):
        cases += f"    {'|'.join(sorted(names))}) _pintle_files '{what}'; return ;;\n"
    top = " ".join([n for o in program.options for n in o.names] + [n for n, _ in program.commands])
    return f"""# Completion of pintle for bash, made of the program's own help.
_pintle_files() {{  # folders, and the files that a glob names
  local IFS=$'\\n'
  compopt -o filenames
  if [[ -z $1 ]]; then COMPREPLY=(); return; fi
  if [[ $1 == / ]]; then COMPREPLY=($(compgen -d -- "$current")); return; fi
  shopt -q extglob || {{ shopt -s extglob; local restore=yes; }}
  COMPREPLY=($(compgen -d -- "$current"; compgen -f -X "!$1" -- "$current" | while read -r f; do [[ -d $f ]] || echo "$f"; done))
  [[ ${{restore-}} ]] && shopt -u extglob
}}
_pintle() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} options='' operand='' command=${{COMP_WORDS[1]}}
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W '{top}' -- "$current"))
    return
  fi
  case $before in
{cases}  esac
  case $command in
{operands}  esac
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  else
    _pintle_files "$operand"
  fi
}}
complete -F _pintle pintle
"""


def quoted(text):
    return text.replace("'", "").replace("[", "(").replace("]", ")").replace(":", ";")


def zsh_value(value):
    what = kind(value)
    action = {"": " ", "/": "_files -/"}.get(what) or f"_files -g \"{what.replace('@(yaml|yml|json)', '(yaml|yml|json)')}\""
    return f":{quoted(value)}:{action}" if value else ""


def zsh(program, commands):
    cases = ""
    for c in commands:
        specs = []
        for o in c.options:
            star = "*" if "repeated" in o.help else f"({' '.join(o.names)})"
            specs += [f"'{star}{n}[{quoted(o.help)}]{zsh_value(o.value)}'" for n in o.names]
        for o in c.operands:
            specs.append(f"'{'*' if o.many else ''}{zsh_value(o.value or o.names[0])}'")
        cases += f"    {c.name.split()[1]}) _arguments -S " + " \\\n      ".join(specs) + " ;;\n"
    words = "\n".join(f"    '{n}:{quoted(w)}'" for n, w in program.commands)
    return f"""#compdef pintle
# Completion of pintle for zsh, made of the program's own help.
_pintle() {{
  local -a commands=(
{words}
  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  ((CURRENT -= 1))
  case $command in
{cases}  esac
}}
_pintle "$@"
"""


def fish(program, commands):
    out = "# Completion of pintle for fish, made of the program's own help.\ncomplete -c pintle -f\n"
    for n, w in program.commands:
        out += f"complete -c pintle -n __fish_use_subcommand -a {n} -d '{quoted(w)}'\n"
    for c in commands:
        of = f"complete -c pintle -n '__fish_seen_subcommand_from {c.name.split()[1]}'"
        for o in c.options:
            names = "".join(f" -l {n[2:]}" if n.startswith("--") else f" -s {n[1:]}" for n in o.names)
            value = {"": " -x", "/": " -x -a '(__fish_complete_directories)'"}.get(kind(o.value), " -r -F") if o.value else ""
            out += f"{of}{names}{value} -d '{quoted(o.help)}'\n"
        what = kind(c.operands[0].value) if c.operands else ""
        if what == "/":
            out += f"{of} -a '(__fish_complete_directories)'\n"
        elif what:
            endings = " ".join(f".{e}" for e in re.findall(r"\w+", what))
            out += "".join(f"{of} -a '(__fish_complete_suffix {e})'\n" for e in endings.split())
    return out


def main(out, pintle, *others):
    out = Path(out)
    program = read_help("pintle", text_of(pintle, "--help"))
    version = text_of(pintle, "--version").split()[-1]
    commands = [read_help(f"pintle {n}", text_of(pintle, n, "--help")) for n, _ in program.commands if is_there(pintle, n)]
    pages = [program, *commands, *(read_help(Path(p).name, text_of(p, "--help")) for p in others)]
    names = [c.name.replace(" ", "-") for c in pages]
    files = {f"man/{n}.1": man_page(c, version, names) for n, c in zip(names, pages)}
    files |= {"bash/pintle": bash(program, commands), "zsh/_pintle": zsh(program, commands), "fish/pintle.fish": fish(program, commands)}
    for name, text in files.items():
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
