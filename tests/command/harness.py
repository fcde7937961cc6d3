"""Runs the command in an empty folder, and checks that a refusal is one line and leaves nothing behind."""

import os
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["MANYLIGHTS_COMMAND"]
SMALL = ["--scene", "cornell", "--detail", "low", "--lights", "500", "--size", "64x36"]


class CommandTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = holder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)
        return self.path(name)

    def run_command(self, *arguments, **environment):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=240,
                              env={**os.environ, **environment})

    def assert_done(self, *arguments, code=0):
        done = self.run_command(*arguments)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        return done

    def assert_refused(self, arguments, codes, pattern, **environment):
        """One line on standard error that matches, nothing on standard output, no file made."""
        before = sorted(os.listdir(self.folder))
        done = self.run_command(*arguments, **environment)
        self.assertIn(done.returncode, codes, done.stderr + done.stdout)
        self.assertRegex(done.stderr, r"\Amanylights: [^\n]+\n\Z")
        self.assertIsNotNone(re.search(pattern, done.stderr), f"{done.stderr!r} does not match {pattern!r}")
        self.assertEqual(done.stdout, "")
        self.assertEqual(sorted(os.listdir(self.folder)), before)
