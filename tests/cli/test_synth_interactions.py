# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""unseen synth interactions: what it writes, and the options that it refuses."""

import json
import signal
import subprocess
import time
import unittest

import numpy

from harness import PROGRAM, CliTest


class SynthInteractions(CliTest):
    def synth(self, *more, out="out"):
        run = self.unseen("synth", "interactions", "-o", out, "--seconds", "8", *more)
        self.assertEqual(run.returncode, 0, run.stderr)
        return self.folder / out

    def files(self, folder):
        return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file() and not path.name.startswith(".")}

    def test_a_folder_holds_a_take_and_its_truth(self):
        out = self.synth("--people", "2", "--seed", "5", "--fps", "10")
        take = json.loads((out / "take.json").read_text())
        self.assertEqual((take["fps"], take["people"], take["format"]), (10, 2, "openpose"))
        self.assertEqual(len(list((out / take["joints"]).iterdir())), 80)
        self.assertEqual({p.name for p in (out / "gt").iterdir() if p.is_file()},
                         {"skel_synth-5-0_GT.json", "skel_synth-5-1_GT.json", "actions.txt", "actions-1.txt", "interacted.json", "room.txt", "licence.txt"})
        for path in (out / "gt" / "skel_synth-5_GT_objects").iterdir():
            axes = numpy.array(json.loads(path.read_text())["axes"])
            numpy.testing.assert_allclose(axes.T @ axes, numpy.eye(3), atol=1e-9)
            self.assertAlmostEqual(numpy.linalg.det(axes), 1)

    def test_the_same_seed_gives_the_same_files(self):
        self.assertEqual(self.files(self.synth("--seed", "4")), self.files(self.synth("--seed", "4", "--threads", "1", out="same")))

    def test_without_lifted_poses_there_is_no_file_of_them(self):
        out = self.synth("--lifted=false")
        self.assertNotIn("lifted", json.loads((out / "take.json").read_text()))
        self.assertFalse((out / "lifted.json").exists())

    def test_an_interrupt_ends_it(self):
        run = subprocess.Popen([PROGRAM, "synth", "interactions", "-o", "out", "--seconds", "600", "--fps", "60"], cwd=self.folder, stderr=subprocess.PIPE, text=True)
        end = time.monotonic() + 30
        while not list(self.folder.iterdir()) and time.monotonic() < end:  # what it writes into, made when it listens
            time.sleep(0.02)
        run.send_signal(signal.SIGINT)
        said = run.communicate(timeout=30)[1]
        self.assertEqual(run.returncode, 130, said)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_refuses_what_is_outside_of_the_range(self):
        run = self.unseen("synth", "interactions", "-o", "out", "--people", "9")
        self.assertEqual(run.returncode, 2)
        self.assertIn("people", run.stderr)
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
