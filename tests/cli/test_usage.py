# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Help, versions, wrong command lines and config files."""

import json
import os
import subprocess
import unittest

from harness import PROGRAM, SOURCE, CliTest

COMMANDS = (["planes"], ["convert"], ["synth", "planes"], ["evaluate", "planes"])


class Help(CliTest):
    def test_every_subcommand_has_an_example(self):
        for command in COMMANDS:
            run = self.unseen(*command, "--help")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn("Example", run.stdout)
            self.assertIn("  unseen " + " ".join(command) + " ", run.stdout)

    def test_planes_help_names_unit_default_and_range(self):
        text = " ".join(self.unseen("planes", "--help").stdout.split())
        for flag in ("--scale", "--angles", "--lambda", "--threshold", "--depth-range", "--depth-step",
                     "--frame-step", "--config", "--dump-config", "--seed", "--threads", "--quiet", "--json",
                     "--no-report", "--no-points", "--version"):
            self.assertIn(flag, text)
        self.assertIn("deg; default 15; 1…45", text)
        self.assertIn("one of local, exact", text)

    def test_version(self):
        version = (SOURCE / "VERSION").read_text().strip()
        for arguments in (["--version"], ["planes", "--version"]):
            run = self.unseen(*arguments)
            self.assertEqual((run.returncode, run.stdout.strip()), (0, "unseen " + version))


class WrongCommandLines(CliTest):
    def test_exit_code_2_and_one_line(self):
        self.room_file()
        for arguments, word in ((["planes", "room.ply", "-o", "out", "--scales", "1"], "--scales"),
                                (["planes", "room.ply"], "-o OUT"),
                                (["planes", "-o", "out"], "CLOUD"),
                                (["planes", "room.ply", "more.ply", "-o", "out"], "more.ply is one argument too many"),
                                (["planes", "--", "room.ply", "more.ply"], "more.ply is one argument too many"),
                                (["planes", "room.ply", "--adaptive-scale", "false"], "false is one argument too many; give it as --option=false"),
                                (["synth", "--", "planes"], "planes is not known;"),
                                (["planes", "room.ply", "-o", "out", "--threads", "-1"], "--threads"),
                                (["sing"], "sing"),
                                (["evaluate", "planes", "out"], "--truth"),
                                (["convert", "room.ply"], "OUT"),
                                (["synth", "planes"], "-o DIR"),
                                ([], "subcommand")):
            with self.subTest(arguments=arguments):
                self.assert_one_line(self.unseen(*arguments), 2, word, "--help")
                self.assertFalse((self.folder / "out").exists())

    def test_says_what_may_have_been_meant(self):
        for arguments, word, meant in ((["planes", "room.ply", "--scal", "1"], "--scal", "--scale"), (["plains", "room.ply"], "plains", "planes"),
                                       (["synth", "plane", "-o", "out"], "plane", "planes"), (["convert", "a.ply", "b.ply", "--quite"], "--quite", "--quiet")):
            with self.subTest(arguments=arguments):
                self.assert_one_line(self.unseen(*arguments), 2, f"{word} is not known (did you mean {meant}?)", "--help")

    def test_does_not_mind_that_nobody_reads_what_it_says(self):
        (self.folder / "room.csv").write_text("x,y,z,intensity\n1,2,3,77\n4,5,6,88\n7,8,1,99\n")  # there is a warning
        for arguments, code in (("convert room.csv room.ply", 0), ("convert none.csv none.ply", 3), ("planes --bad", 2)):
            for stderr in ("2>&-", "2>/dev/full"):
                with self.subTest(arguments=arguments, stderr=stderr):
                    run = subprocess.run(f"'{PROGRAM}' {arguments} {stderr}", shell=True, cwd=self.folder, timeout=60)
                    self.assertEqual(run.returncode, code)
        self.assertTrue((self.folder / "room.ply").exists())
        for arguments, code in ((["convert", "room.csv", "again.ply"], 0), (["convert", "none.csv", "none.ply"], 3), (["--help"], 0)):
            with self.subTest(arguments=arguments):
                reading, writing = os.pipe()
                os.close(reading)
                run = subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdout=writing, stderr=writing, timeout=60)
                os.close(writing)
                self.assertEqual(run.returncode, code)
        self.assertEqual((self.folder / "room.ply").read_bytes(), (self.folder / "again.ply").read_bytes())

    def test_option_values_are_checked(self):
        self.room_file()
        for flag, value, expected in (("--scale", "0", "number"), ("--scale", "-1", "number"),
                                      ("--scale", "nan", "number"), ("--scale", "big", "number"),
                                      ("--angles", "0", "1…180"), ("--angles", "200", "1…180"),
                                      ("--angles", "right", "1…180"), ("--angles", "60,", "1…180"),
                                      ("--lambda", "1.5", "0…1"), ("--solver", "magic", "local, exact"),
                                      ("--seed", "0.5", "whole"), ("--threshold", "2", "0…1")):
            with self.subTest(flag=flag, value=value):
                run = self.unseen("planes", "room.ply", "-o", "out", flag, value)
                self.assert_one_line(run, 2, "command line: " + flag[2:], value, "expected", expected)
                self.assertFalse((self.folder / "out").exists())

    def test_lists_have_the_numbers_that_they_need(self):
        self.room_file()
        for flag, value, found, expected in (("--viewpoint", "1,2", "[1, 2]", "3 numbers x,y,z"),
                                             ("--viewpoint", "1", "[1]", "3 numbers x,y,z"),
                                             ("--depth-range", "2", "[2]", "2 numbers nearest,farthest"),
                                             ("--depth-range", "1,1", "[1, 1]", "nearest < farthest"),
                                             ("--depth-range", "3.5,0.3", "[3.5, 0.3]", "nearest < farthest")):
            with self.subTest(flag=flag, value=value):
                run = self.unseen("planes", "room.ply", "-o", "out", flag, value)
                self.assert_one_line(run, 2, "command line: " + flag[2:].replace("-", "_"), found, expected)
                self.assertFalse((self.folder / "out").exists())


class Config(CliTest):
    def write(self, text):
        (self.folder / "my.toml").write_text(text)

    def options(self, *arguments):
        run = self.unseen("planes", self.room_file(), "-o", "out", *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads((self.folder / "out/result.json").read_text())["options"]

    def test_file_sets_and_command_line_wins(self):
        self.write("scale = 0.2\nangles = [60, 90]\nsolver = 'exact'\n")
        options = self.options("--config", "my.toml", "--scale", "0.15")
        self.assertEqual((options["scale"], options["angles"], options["solver"]), (0.15, [60, 90], "exact"))

    def test_dump_config_needs_nothing_else(self):
        for command in (*COMMANDS, ["cuboids"], ["collision"], ["interactions"], ["stage"], ["view"], ["evaluate", "cuboids"], ["synth", "collision"]):
            with self.subTest(command=command):
                run = self.unseen(*command, "--dump-config")
                self.assertEqual((run.returncode, run.stderr), (0, ""))
                self.assertIn("[", run.stdout)

    def test_dump_config_round_trip(self):
        given = ("--scale", "0.061", "--angles", "45,60", "--adaptive-scale", "--viewpoint", "-1,2.5,3", "--seed", "9")
        first = self.unseen("planes", "--dump-config", *given)
        self.assertEqual(first.returncode, 0, first.stderr)
        self.write(first.stdout)
        second = self.unseen("planes", "--config", "my.toml", "--dump-config")
        self.assertEqual(second.stdout, first.stdout)
        defaults = self.unseen("planes", "--dump-config")
        self.assertNotEqual(defaults.stdout, first.stdout)
        self.write(defaults.stdout)
        self.assertEqual(self.unseen("planes", "--config", "my.toml", "--dump-config").stdout, defaults.stdout)

    def test_bad_files(self):
        self.room_file()
        for text, words in (("scales = 1\n", ("my.toml", "scales", "patch_angle")),
                            ("scale = -1\n", ("my.toml", "scale", "-1")),
                            ("scale = 'big'\n", ("my.toml", "scale", "big")),
                            ("scale = = 1\n", ("my.toml",)),
                            ("scale = 1\nscale = 2\n", ("my.toml",))):
            with self.subTest(text=text):
                self.write(text)
                run = self.unseen("planes", "room.ply", "-o", "out", "--config", "my.toml")
                self.assert_one_line(run, 3, *words)
                self.assertFalse((self.folder / "out").exists())
        self.assert_one_line(self.unseen("planes", "room.ply", "-o", "out", "--config", "none.toml"), 3, "none.toml")


if __name__ == "__main__":
    unittest.main()
