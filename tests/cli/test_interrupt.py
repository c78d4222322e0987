# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Ctrl-C and worse, in the middle of a run: the earlier result stays as it was, or the new one is whole."""

import json
import os
import pty
import re
import select
import signal
import subprocess
import time
import unittest

from harness import PROGRAM, CliTest, contents


class Interrupt(CliTest):
    def setUp(self):
        super().setUp()
        self.room_file("small.ply")
        self.assertEqual(self.unseen("planes", "small.ply", "-o", "out").returncode, 0)
        self.before = contents(self.folder / "out")
        self.room_file("large.ply", count=1_500_000)
        self.names = sorted(p.name for p in self.folder.iterdir())

    def start(self):
        """The program with a terminal as standard error; returns process and the terminal's other end."""
        terminal, theirs = pty.openpty()
        self.addCleanup(os.close, terminal)
        run = subprocess.Popen([PROGRAM, "planes", "large.ply", "-o", "out", "--scale", "0.05"], cwd=self.folder,
                               stdout=subprocess.PIPE, stderr=theirs)
        self.addCleanup(run.stdout.close)
        os.close(theirs)
        return run, terminal

    def follow(self, run, terminal, until=None, timeout=240):
        """Reads the terminal until a pattern comes or the program ends; returns all text."""
        text, end = "", time.monotonic() + timeout
        while time.monotonic() < end:
            if select.select([terminal], [], [], 0.05)[0]:
                try:
                    data = os.read(terminal, 65536)
                except OSError:
                    break
                if not data:
                    break
                text += data.decode(errors="replace")
            elif run.poll() is not None:
                break
            if until and re.search(until, text):
                return text
        run.wait(timeout=60)
        return text

    def stages(self):
        """Names of the stages, as the progress line shows them."""
        run, terminal = self.start()
        text = self.follow(run, terminal)
        self.assertEqual(run.returncode, 0, text)
        names = re.findall(r"\x1b\[K([^\[\r]+?) +\[[= ]*\]", text)
        self.assertTrue(names, text)
        return list(dict.fromkeys(names))

    def assert_old_or_new(self, run, text):
        if run.returncode == 130:
            self.assertEqual(contents(self.folder / "out"), self.before)
            self.assertIn("interrupted", text)
        else:
            self.assertEqual(run.returncode, 0, text)
            result = json.loads((self.folder / "out/result.json").read_text())
            self.assertEqual(result["input"]["path"], "large.ply")
            self.before = contents(self.folder / "out")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), self.names)

    def test_in_every_stage(self):
        stages = self.stages()
        self.before = contents(self.folder / "out")
        codes = []
        for stage in stages:
            with self.subTest(stage=stage):
                run, terminal = self.start()
                self.follow(run, terminal, until=re.escape(stage) + r" +\[")
                run.send_signal(signal.SIGINT)
                text = self.follow(run, terminal)
                codes.append(run.returncode)
                self.assert_old_or_new(run, text)
        self.assertGreaterEqual(codes.count(130), (len(codes) + 1) // 2, list(zip(stages, codes)))

    def test_terminate_and_hangup_are_the_same(self):
        for sent in (signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(sent) == signal.SIG_IGN:  # under nohup, which the program respects
                continue
            with self.subTest(sent=sent):
                run, terminal = self.start()
                self.follow(run, terminal, until=r"\[[= ]*\]")
                run.send_signal(sent)
                if sent == signal.SIGHUP:  # a terminal that closes may say so twice
                    time.sleep(0.005)
                    run.send_signal(sent)
                text = self.follow(run, terminal)
                self.assertEqual(run.returncode, 130, text)
                self.assert_old_or_new(run, text)

    def test_kill_leaves_the_old_result(self):
        run, terminal = self.start()
        self.follow(run, terminal, until=r"\[[= ]*\]")
        run.send_signal(signal.SIGKILL)
        self.follow(run, terminal)
        self.assertEqual(run.returncode, -signal.SIGKILL)
        self.assertEqual(contents(self.folder / "out"), self.before)


if __name__ == "__main__":
    unittest.main()
