#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The installed files of each component are the files of the sources, and the
installed tools start.

Usage: installed_set.py BUILD SOURCE SCRATCH, where BUILD is the folder of a build.
Exits with 77 if the program or the library has not been built.

Each component is installed into a folder of its own below SCRATCH:

  * all files of share/talus, prm and doc/man are installed, with the same contents,
  * each tool (share/talus/talus-*) is executable, starts with --help, has a man page
    and a completion for bash with all options, and is named by talus.1,
  * the package recommends the Python packages that the tools name,
  * installed headers include installed headers only,
  * no other file is installed, and no file by two components.

Each failure is a sentence with the name of the file.
"""

import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys

BUILD, SOURCE, SCRATCH = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
SHARE = SOURCE / "share" / "talus"
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
PACKAGES = {"program": "talus", "development": "talus-dev", "python": "python3-talus"}
ENVIRONMENT = os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}


def files_below(folder):
    """Paths of all files below the folder, relative to the folder; no caches."""
    return sorted(path.relative_to(folder) for path in folder.rglob("*")
                  if (path.is_file() or path.is_symlink())
                  and path.suffix != ".pyc" and "__pycache__" not in path.parts)


def tools():
    """Paths of the tools in the sources."""
    return [path for path in sorted(SHARE.glob("talus-*")) if path.is_file()]


def of_package(component):
    """Files that Debian wants in each package: place and file of the build."""
    package = PACKAGES[component]
    return {f"share/doc/{package}/copyright": BUILD / "copyright",
            f"share/doc/{package}/changelog.Debian.gz": BUILD / "changelog.Debian.gz",
            f"share/lintian/overrides/{package}": BUILD / f"overrides.{package}"}


def of_program():
    """Place and source of each file of the component `program`, which are not
    compiled."""
    expected = of_package("program")
    for file in files_below(SOURCE / "prm"):
        expected[f"share/talus/prm/{file}"] = SOURCE / "prm" / file
    for file in files_below(SHARE):
        if str(file) != "talus.bash" and SHARE / file not in tools():
            expected[f"share/talus/{file}"] = SHARE / file
    for tool in tools():
        expected[f"bin/{tool.name}"] = tool
    for command in ["talus", *(tool.name for tool in tools())]:
        expected[f"share/bash-completion/completions/{command}"] = SHARE / "talus.bash"
    for page in sorted((SOURCE / "doc" / "man").glob("*.1")):
        expected[f"share/man/man1/{page.name}.gz"] = page
    for folder in "share/talus", "share/doc/talus":
        expected[f"{folder}/parameters.prm"] = SOURCE / "doc" / "parameters.prm"
    return expected


def of_development(installed):
    """The same of `development`. Of the headers, those that are installed."""
    expected = of_package("development")
    for file in files_below(SOURCE / "doc" / "examples"):
        expected[f"share/talus/examples/{file}"] = SOURCE / "doc" / "examples" / file
    for file in installed:
        match = re.search(r"(?:^|/)include/(talus/.*\.h)$", file)
        if match:
            header = SOURCE / "include" / match.group(1)
            generated = BUILD / "include" / match.group(1)
            expected[file] = header if header.exists() else generated
        match = re.search(r"/cmake/talus/([^/]*)$", file)
        if match:
            kept = SOURCE / "cmake" / match.group(1)
            expected[file] = kept if kept.exists() else BUILD / match.group(1)
    return expected


def of_python(installed):
    """The same of `python`, whose folder can be chosen."""
    expected = of_package("python")
    folder = next((os.path.dirname(file) for file in installed
                   if file.endswith("/talus/__init__.py")), "lib/python3/dist-packages/talus")
    for file in (SHARE / "talus").glob("*.py"):
        expected[f"{folder}/{file.name}"] = file
    return expected


# Compiled files of each component, one of each kind at least.
COMPILED = {"program": [r"bin/talus", r"lib.*/libtalus\.so\.[\d.]+"],
            "development": [r"lib.*/libtalus\.so"],
            "python": [r".*/talus/_talus\.[^/]*so"]}


def contents(path):
    data = path.read_bytes()
    return gzip.decompress(data) if path.suffix == ".gz" else data


def compare(component, prefix):
    """Sentences on missing, other and unknown files of a component."""
    installed = [str(file) for file in files_below(prefix)]
    expected = {"program": of_program,
                "development": lambda: of_development(installed),
                "python": lambda: of_python(installed)}[component]()
    for pattern in COMPILED[component]:
        if not any(re.fullmatch(pattern, file) for file in installed):
            yield f"The component {component} installs no file '{pattern}'."
    for file, source in sorted(expected.items()):
        if file not in installed:
            yield (f"{source} is not installed: the component {component} has no file "
                   f"'{file}'.")
        elif not source.exists() or contents(prefix / file) != contents(source):
            yield f"The installed file '{file}' differs from {source}."
    for file in installed:
        if file not in expected and not any(
                re.fullmatch(pattern, file) for pattern in COMPILED[component]):
            yield f"The component {component} installs '{file}', which is not known."


def includes_of_headers(prefix):
    """Sentences on headers that include a header that is not installed."""
    headers = {str(file).split("include/", 1)[1]: prefix / file
               for file in files_below(prefix) if "include/" in str(file)}
    if not headers:
        yield "The component development installs no headers."
    for name, header in headers.items():
        for included in re.findall(r"^ *# *include *<(talus/.*)>", header.read_text(),
                                   re.MULTILINE):
            if included not in headers:
                yield f"The installed header {name} includes {included}, which is not installed."


def completions(name):
    """Words that bash offers for '--' behind the command."""
    script = (f"source '{SHARE / 'talus.bash'}'; "
              f"function=$(complete -p {name} | sed 's/.*-F \\([^ ]*\\).*/\\1/'); "
              f"COMP_WORDS=({name} --); COMP_CWORD=1; $function {name} -- {name}; "
              'printf "%s\\n" "${COMPREPLY[@]}"')
    result = subprocess.run(["bash", "-c", script], capture_output=True, text=True)
    return set(result.stdout.split())


def help_of(path):
    """Text of --help of a program, and a sentence if the program does not start."""
    if not os.access(path, os.X_OK):
        return "", f"'{path}' is missing, or not executable."
    try:
        result = subprocess.run([path, "--help"], capture_output=True, text=True,
                                env=ENVIRONMENT)
    except OSError as error:
        return "", f"'{path}' does not start: {error.strerror}."
    if result.returncode != 0:
        return "", (f"'{path} --help' ended with status {result.returncode}: "
                    f"{result.stderr.strip()}")
    return result.stdout, None


def sentences_on_tool(tool, prefix, overview):
    """Start, man page and completion of a tool; overview is the text of talus.1."""
    text, problem = help_of(prefix / "bin" / tool.name)
    if problem:
        yield problem
        return
    options = set(OPTION.findall(text.split("\noptions:\n")[-1]))
    page = SOURCE / "doc" / "man" / f"{tool.name}.1"
    if not page.exists():
        yield f"The tool {tool.name} has no man page: there is no {page}."
    else:
        text = page.read_text().replace("\\-", "-")
        listed = set(re.findall(r"^.*\\fB(--[a-z-]+)\\fR.*$",
                                text.split(".SH OPTIONS")[-1], re.MULTILINE))
        if listed != options:
            yield (f"{page} has the options {sorted(listed)}, and '{tool.name} --help' "
                   f"{sorted(options)}.")
    offered = completions(tool.name)
    if offered != options:
        yield (f"{SHARE / 'talus.bash'} completes {tool.name} by {sorted(offered)}, and "
               f"'{tool.name} --help' has {sorted(options)}.")
    if f"{tool.name} (1)" not in overview:
        yield f"doc/man/talus.1 does not name {tool.name} under SEE ALSO."


def sentences_on_packages():
    """Python packages that a tool names, and the package does not recommend."""
    match = re.search(r'set\(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "(.*)"\)',
                      (BUILD / "CPackConfig.cmake").read_text())
    recommended = match.group(1).split(", ") if match else []
    for tool in tools():
        for name in sorted(set(re.findall(r"python3-\w+", tool.read_text()))):
            if name not in recommended:
                yield (f"{tool} needs {name}, which cmake/package.cmake does not "
                       "recommend.")


def components():
    """Components that the build has."""
    found = ["program", "development"]
    if list((BUILD / "python" / "talus").glob("_talus*.so")):
        found.append("python")
    return found


def problems():
    """Sentences on all that is wrong."""
    owner = {}
    for component in components():
        prefix = SCRATCH / component
        subprocess.run(["cmake", "--install", BUILD, "--prefix", prefix, "--component",
                        component], check=True, stdout=subprocess.DEVNULL)
        yield from compare(component, prefix)
        for file in files_below(prefix):
            if file in owner:
                yield f"'{file}' is in the components {owner[file]} and {component}."
            owner[file] = component
    _, problem = help_of(SCRATCH / "program" / "bin" / "talus")
    if problem:
        yield problem
    overview = (SOURCE / "doc" / "man" / "talus.1").read_text().replace("\\-", "-")
    for tool in tools():
        yield from sentences_on_tool(tool, SCRATCH / "program", overview)
    yield from includes_of_headers(SCRATCH / "development")
    yield from sentences_on_packages()


def main():
    for path in BUILD / "talus", BUILD / "lib" / "libtalus.so":
        if not path.exists():
            print(f"'{path}' has not been built.")
            return 77
    shutil.rmtree(SCRATCH, ignore_errors=True)
    found = list(problems())
    for sentence in found:
        print(sentence)
    if not found:
        print(f"The components {', '.join(components())} are as expected, with "
              f"{len(tools())} tools.")
    return len(found) > 0


if __name__ == "__main__":
    sys.exit(main())
