"""What explains the program: --help, completions and man pages."""
import re
import shutil
import subprocess
import unittest

from harness import BUILD, FBS, ProgramTest

COLUMNS = 100
SHELLS = ("bash", "zsh", "fish")


class Manual(ProgramTest):
    def verbs(self):
        listed = self.succeed("--help").decode().partition("Verbs:")[2]
        found = re.findall(r"(?m)^  ([a-z]+)  ", listed.partition("Examples:")[0])
        self.assertGreater(len(found), 6)
        return found

    def options(self, verb):
        return set(re.findall(r"(?m)^  (?:-\w,)?(--[a-z0-9-]+)", self.succeed(verb, "--help").decode()))

    def completed(self, *words):
        script = self.succeed("completions", "bash").decode()
        done = subprocess.run(["bash", "-c", script + "COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _fbs; "
                               "printf '%s\\n' \"${COMPREPLY[@]}\"", "bash", *words],
                              cwd=self.folder, capture_output=True, text=True, check=True)
        return set(done.stdout.split())

    def test_every_verb_has_examples_and_lines_that_fit(self):
        self.assertLessEqual(max(map(len, self.succeed("--help").decode().splitlines())), COLUMNS)
        for verb in self.verbs():
            with self.subTest(verb=verb):
                text = self.succeed(verb, "--help").decode()
                self.assertIn(f"fbs {verb}", text.partition("Examples:")[2])
                self.assertLessEqual(max(map(len, text.splitlines())), COLUMNS)
                self.assertNotRegex(text, r"\b(INT|FLOAT|TEXT|UINT):?\b")
                self.assertNotIn("no-snakes", text, "an option for measurements")

    def test_bash_completes_verbs_options_and_files(self):
        self.assertEqual(self.completed("fbs", "ret"), {"retarget"})
        self.assertLessEqual(set(self.verbs()), self.completed("fbs", ""))
        for verb in self.verbs():
            self.assertLessEqual(self.options(verb), self.completed("fbs", verb, "--"), verb)
        self.write("talk.fbs", b"")
        self.assertEqual(self.completed("fbs", "play", "ta"), {"talk.fbs"})

    def test_scripts_are_valid(self):
        for shell in SHELLS:
            with self.subTest(shell=shell):
                script = self.succeed("completions", shell)
                self.assertIn(b"evaluate", script)
                if shutil.which(shell):
                    done = subprocess.run([shell, "-n", "/dev/stdin"], input=script, capture_output=True, check=False)
                    self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.fail_cleanly("completions", "tcsh", says=["tcsh"])

    def test_man_pages(self):
        if not (shutil.which("help2man") and shutil.which("lowdown")):
            raise unittest.SkipTest("help2man and lowdown are not installed")
        for verb in self.verbs():
            with self.subTest(verb=verb):
                page = (BUILD / f"docs/fbs-{verb}.1").read_text().replace("\\-", "-")
                self.assertIn("EXAMPLES", page)
                self.assertNotIn("??", page, "a letter that help2man does not know")
                for option in self.options(verb):
                    self.assertIn(option, page)
