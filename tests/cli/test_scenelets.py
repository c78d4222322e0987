# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""unseen scenelets: building, extending and describing databases; the shipped one is what the generator makes."""

import json
import unittest

from harness import SOURCE, CliTest


class Scenelets(CliTest):
    def info(self, *arguments):
        run = self.unseen("scenelets", "info", *arguments, "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(run.stdout)

    def build(self, *arguments):
        run = self.unseen("scenelets", "build", *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_the_shipped_database_is_what_the_generator_makes(self):
        self.build("--synth", 40, "-o", "again.bin")
        self.assertTrue((self.folder / "again.bin").read_bytes() == (SOURCE / "data/scenelets.bin").read_bytes(),
                        "data/scenelets.bin is out of date: unseen scenelets build --synth 40 -o data/scenelets.bin")
        self.assertEqual(self.info(), self.info("again.bin"))

    def test_a_scene_folder_and_a_database_make_a_larger_one(self):
        self.assertEqual(self.unseen("synth", "interactions", "-o", "room", "--seed", 7).returncode, 0)
        (self.folder / "room/gt/licence.txt").write_text("CC0-1.0\n")
        self.build("--synth", 2, "-o", "two.bin")
        self.build("room", "-o", "one.bin")
        self.build("room", "--add", "two.bin", "-o", "three.bin")
        two, one, three = (self.info(name) for name in ("two.bin", "one.bin", "three.bin"))
        self.assertEqual(three["scenelets"], one["scenelets"] + two["scenelets"])
        self.assertEqual([r["licence"] for r in three["recordings"]].count("CC0-1.0"), 1)
        self.assertEqual(sum(a["scenelets"] for a in three["actions"].values()), three["scenelets"])
        self.build("--add", "three.bin", "--add", "two.bin", "-o", "same.bin")  # nothing new
        self.assertEqual(self.info("same.bin")["scenelets"], three["scenelets"])

    def test_sitting_is_salient_and_walking_is_not(self):
        actions = self.info()["actions"]
        self.assertGreater(actions["sitting"]["saliency"][2], 0.5)
        self.assertLess(actions["walking"]["saliency"][2], 0.15)

    def test_bad_calls_and_files(self):
        self.assert_one_line(self.unseen("scenelets", "build", "-o", "x.bin"), 2, "FOLDER")
        self.assert_one_line(self.unseen("scenelets", "build", "--synth", 1), 2, "-o")
        self.assert_one_line(self.unseen("scenelets", "build", "--synth", 1, "--step", 0, "-o", "x.bin"), 2, "step")
        self.assert_one_line(self.unseen("scenelets", "build", "nowhere", "-o", "x.bin"), 3, "nowhere")
        (self.folder / "text.bin").write_text("hello")
        self.assert_one_line(self.unseen("scenelets", "info", "text.bin"), 3, "text.bin", "scenelet database")
        self.assertFalse((self.folder / "x.bin").exists())


if __name__ == "__main__":
    unittest.main()
