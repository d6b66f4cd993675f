#!/usr/bin/env python3
"""program_pages.py PROGRAM FOLDER: writes the man page spf.1 and the completion for bash, spf, of a program.

Both are read off the program's own help, so they say what it says. Help that has another form than expected is an error, and
nothing is left out in silence."""
import re
import subprocess
import sys
from pathlib import Path

HEADINGS = ("Positionals", "Options", "Subcommands")
ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(\S.*))?$")


class FormError(ValueError):
    """The help has a line that is none of those expected."""


def help_of(program, *verb):
    run = subprocess.run([program, *verb, "--help"], capture_output=True, text=True, check=True)
    return run.stdout


def entry_of(line):
    """Name and meaning of a line of a list; an option whose name is too long has its meaning on the next line, or after one blank."""
    match = ENTRY.match(line)
    if not match:
        raise FormError(f"not understood in the help: {line!r}")
    return [match.group(1), match.group(2) or ""]


def sections_of(text):
    """The help as its head, its lists by heading, and its foot."""
    lists, heading, head, foot = {}, None, [], []
    for line in text.splitlines():
        if line.rstrip(":") in HEADINGS and line.endswith(":"):
            heading = line[:-1]
            lists[heading] = []
        elif not line.strip():
            heading = heading and ""
        elif heading:
            if line.startswith(" " * 10) and lists[heading]:
                last = lists[heading][-1]
                last[1] = f"{last[1]} {line.strip()}".strip()
            else:
                lists[heading].append(entry_of(line))
        else:
            (head if heading is None else foot).append(line)
    return head, lists, foot


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return "\\&" + text if text.startswith(".") else text


def list_text(entries):
    return "".join(f".TP\n.B {escaped(name)}\n{escaped(what)}\n" for name, what in entries)


def foot_text(foot):
    """Examples as they stand, and the rest as text."""
    lines = []
    for line in foot:
        example = line.startswith("  ") or line == "Examples:"
        lines.append(f".br\n{escaped(line.strip())}" if example else escaped(line))
    return "\n".join(lines) + "\n" if lines else ""


def man_page(version, main, verbs):
    head, lists, foot = main
    names = dict(lists["Subcommands"])
    text = [f'.TH SPF 1 "" "spf {version}" "User Commands"\n.SH NAME\nspf \\- simulate robots among people and moving obstacles',
            ".SH SYNOPSIS\n.B spf\n.I VERB\n[\\fIOPTION\\fR]...", ".SH DESCRIPTION\n" + "\n".join(
                escaped(line) for line in head if not line.startswith("Usage:")),
            ".SH OPTIONS\n" + list_text(lists["Options"])]
    for verb, (verb_head, verb_lists, verb_foot) in verbs.items():
        usage = next(line for line in verb_head if line.startswith("Usage:")).removeprefix("Usage: ")
        text.append(f".SH {verb.upper()}\n{escaped(names[verb])}\n.PP\n.B {escaped(usage)}\n"
                    + list_text(verb_lists.get("Positionals", []) + verb_lists["Options"]) + ".PP\n" + foot_text(verb_foot))
    text.append(".SH EXAMPLES AND EXIT STATUS\n" + foot_text(foot))
    text.append(".SH FILES\n.I /usr/share/spf/scenarios\nholds the scenarios and campaigns that the examples name.\n")
    return re.sub(r"\n{2,}", "\n", "\n".join(text))


def options_of(lists):
    """Options of a list, and of these the ones that take a value."""
    names = [name for name, _ in lists["Options"]]
    options = [re.findall(r"--[\w-]+", name)[0] for name in names]
    return options, [option for option, name in zip(options, names) if re.search(r"--[\w-]+ \S", name)]


def completion(main, verbs):
    _, lists, _ = main
    cases = []
    for verb, (_, verb_lists, _) in verbs.items():
        options, valued = options_of(verb_lists)
        cases.append(f"    {verb})\n      options='{' '.join(options)}'\n      valued=' {' '.join(valued)} ' ;;")
    return f"""# bash completion for spf, made by script/program_pages.py of the program's own help
_spf() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} options='' valued='' found=''
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    found=$(compgen -W '{' '.join([name for name, _ in lists['Subcommands']] + options_of(lists)[0])}' -- "$word")
  fi
  case ${{COMP_WORDS[1]}} in
{chr(10).join(cases)}
  esac
  if ((COMP_CWORD == 1)); then
    :
  elif [[ $word == -* ]]; then
    found=$(compgen -W "$options" -- "$word")
  elif [[ $valued != *" $before "* || $before == --out || $before == --json || $before == --charts ]]; then
    found=$(compgen -f -- "$word")
  fi
  [[ -z $found ]] || mapfile -t COMPREPLY <<<"$found"
}}
complete -o filenames -F _spf spf
"""


def pages(program):
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
    main = sections_of(help_of(program))
    verbs = {name: sections_of(help_of(program, name)) for name, _ in main[1]["Subcommands"]}
    return man_page(version, main, verbs), completion(main, verbs)


def write_pages(program, folder):
    man, bash = pages(program)
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "spf.1").write_text(man, encoding="utf-8")
    (folder / "spf").write_text(bash, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        write_pages(*sys.argv[1:])
    except (FormError, OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"program_pages.py: {error}")
