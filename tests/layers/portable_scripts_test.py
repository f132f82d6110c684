"""The shell scripts that users run need only what Linux, macOS and the BSDs share. `readlink -f`
counts as shared: macOS has it since version 12.3. Neither they nor the Python files depend on the
locale."""

import ast
import glob
import os
import re
import shutil
import subprocess
import unittest

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)
SCRIPTS = (
    "swirl",
    "check",
    "cmake/launcher.sh",
    "web/lab.sh",
    "web/site.sh",
    "bindings/python/python.sh",
    "bench/run",
)
# Commands and options that only GNU or Linux has, and their replacements.
NOT_PORTABLE = {
    r"(?<!:)\bflock\b(?! FOLDER,)": "lock of cmake/launcher.sh, which calls that of perl",
    r"\bnproc\b": "getconf _NPROCESSORS_ONLN",
    r"\bmktemp\b[^|;&]*--": "a template that ends with X",
    r"\bmv -T\b|\bcp -T\b|\bln -T\b": "rename of cmake/launcher.sh",
    r"\bsed (?:-\w+ )*(?:-i|-r|-z|--)\b": "sed -e with basic expressions and a new file",
    r"\bstat -\w": "find, ls or [ -nt ]",
    r"\bdate -d\b|\bdate --": "find -newer",
    r"\binstall -D\b": "mkdir -p and cp",
    r"\bxargs -\w*[rd]": "find -exec … +",
    r"\bgrep -\w*P": "grep -E",
    r"\bfind\b[^|;]*-(?:quit|printf|executable|regextype)\b": "-print with head, or -exec",
    r"\b(?:tac|shuf|seq|timeout|taskset|setsid|sha256sum|md5sum|realpath|getent|pidof|free)\b(?=[ )])": "a tool of POSIX",
    r"\b(?:head|tail) -[nc] ?-\d": "sed",
    r"\bsort -\w*V|\bls --|\bcp -a\b|\btouch -d\b|\bdu -b\b|\bcp --": "an option of POSIX",
    r"\becho -[ne]\b": "printf",
    r"(?<!LC_ALL=C )\bsort\b(?! +-[a-z]*V)": "LC_ALL=C sort, whose order is the same in every "
    "locale",
}
# system_python() of the launcher chooses the interpreter.
PYTHON = r"/usr/bin/python3?"
# The folders of the Python files that users run.
PYTHON_FOLDERS = ("bindings/python", "paper", "examples", "web", "docs", "bench")


def lacks_encoding(call):
    """Whether this call reads or writes text in the encoding of the locale, which is not UTF-8
    everywhere."""
    name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
    given = {keyword.arg: keyword.value for keyword in call.keywords}
    if "encoding" in given or None in given:
        return False
    if name in ("read_text", "write_text"):
        return len(call.args) < (1 if name == "read_text" else 2)
    if isinstance(call.func, ast.Name) and name == "open":
        mode = call.args[1] if len(call.args) > 1 else given.get("mode")
        return not (isinstance(mode, ast.Constant) and "b" in mode.value)
    is_text = [given.get(option) for option in ("text", "universal_newlines")]
    return name in ("run", "Popen", "check_output") and any(
        isinstance(a, ast.Constant) and a.value for a in is_text
    )


def code_of(name):
    with open(os.path.join(SOURCE, name), encoding="utf-8") as file:
        text = file.read()
    text = re.sub(r"<<'(\w+)'\n.*?^\1$", "", text, flags=re.S | re.M)  # usage texts and pages
    text = text.replace("\\\n", " ")
    return re.sub(r"(?m)(^|\s)#.*$", "", text)


class PortableScripts(unittest.TestCase):
    def test_the_patterns_find_what_they_name(self):
        for line in (
            "flock 9",
            "make -j$(nproc)",
            "mktemp -d --suffix=.x a.XX",
            "mv -T a b",
            "sed -i s/a/b/ c",
            "stat -c %s a",
            "install -D a b",
            "find . -name a -quit",
            "grep -qP a",
            "for k in $(seq 3)",
            "timeout 3 a",
            "head -n -1 a",
            "echo -n a",
            "xargs -r rm",
            "ls | sort -u",
        ):
            self.assertTrue(any(re.search(p, line) for p in NOT_PORTABLE), line)

    def test_no_script_needs_gnu_or_linux(self):
        for name in SCRIPTS:
            code = code_of(name)
            for pattern, instead in NOT_PORTABLE.items():
                with self.subTest(name, pattern=pattern):
                    found = re.search(pattern, code)
                    self.assertIsNone(found, f"use {instead}")
            self.assertEqual(len(re.findall(PYTHON, code)), name == "cmake/launcher.sh", name)

    def test_every_script_is_posix_or_says_bash(self):
        shells = [shell for shell in ("dash", "bash") if shutil.which(shell)]
        for name in SCRIPTS:
            with open(os.path.join(SOURCE, name), encoding="utf-8") as file:
                first = file.readline()
            for shell in shells if "bash" not in first else ["bash"]:
                done = subprocess.run(
                    [shell, "-n", os.path.join(SOURCE, name)], capture_output=True, text=True
                )
                self.assertEqual((done.returncode, done.stderr), (0, ""), f"{shell} {name}")

    def test_every_python_file_says_the_encoding_of_text(self):
        for code, lacks in (
            ("open(f)", True),
            ("open(f, 'rb')", False),
            ("open(f, encoding='utf-8')", False),
            ("run(a, text=True)", True),
            ("run(a)", False),
            ("p.read_text()", True),
        ):
            self.assertEqual(lacks_encoding(ast.parse(code).body[0].value), lacks, code)
        paths = [
            path
            for folder in PYTHON_FOLDERS
            for path in glob.glob(os.path.join(SOURCE, folder, "**", "*.py"), recursive=True)
            if "node_modules" not in path and "paper/tests" not in path
        ]
        self.assertGreater(len(paths), 50)
        for path in paths:
            with open(path, encoding="utf-8") as file:
                calls = [
                    node for node in ast.walk(ast.parse(file.read())) if isinstance(node, ast.Call)
                ]
            with self.subTest(os.path.relpath(path, SOURCE)):
                self.assertEqual([call.lineno for call in calls if lacks_encoding(call)], [])


if __name__ == "__main__":
    unittest.main()
