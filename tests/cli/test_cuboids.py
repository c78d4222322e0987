# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""unseen cuboids: what it prints and writes, and the input that it refuses."""

import json
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

import jsonschema
import numpy

import frames
from harness import PROGRAM, SOURCE, CliTest, contents, glb_json
from scene import scenes_of

FILES = {"result.json", "scene.glb", "scene.xml", "scene.urdf", "report.html"}


class Cuboids(CliTest):
    def solve(self, *more, **fields):
        frames.write_frame(self.folder, **fields)
        run = self.unseen("cuboids", "frame.json", "-o", "out", *more)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run

    def result(self, out="out"):
        return json.loads((self.folder / out / "result.json").read_text())

    def test_evaluates_without_a_truth_whether_it_stands(self):
        self.solve()
        run = self.unseen("evaluate", "cuboids", "out")
        self.assertEqual(run.returncode, 0, run.stderr)
        evaluation = json.loads((self.folder / "out/evaluation.json").read_text())
        self.assertEqual(evaluation["cuboids"], len(self.result()["cuboids"]))
        self.assertNotIn("contacts", evaluation)
        self.assertNotIn("contacts", run.stdout)
        if "built without MuJoCo" in run.stderr:
            self.skipTest("built without MuJoCo")
        self.assertEqual(evaluation["referee"]["still"], evaluation["referee"]["bodies"])
        self.assertEqual(evaluation["referee"]["moved"], [])
        self.assertIn("stand still in MuJoCo", run.stdout)
        for flags in (["--referee=false"], ["--frame", "frame.json"]):  # nothing to measure; what is the frame for?
            run = self.unseen("evaluate", "cuboids", "out", *flags)
            self.assertEqual(run.returncode, 2)
            self.assertIn("--truth", run.stderr)

    def test_applications_write_their_files_and_say_so(self):
        self.solve()
        first = self.result()["cuboids"][0]["id"]
        (self.folder / "edits.json").write_text(json.dumps({"edits": [{"id": first, "remove": True}]}))
        (self.folder / "models").mkdir()
        corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        (self.folder / "models/cube.obj").write_text("".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces))
        run = self.solve("--edit", "edits.json", "--retrieve", "models", "--object", str(first), "--seed", "5")
        self.assertEqual(set(contents(self.folder / "out")), FILES | {"edited.png", "retrieved.json", "retrieved.ply"})
        self.assertIn("best of 1 model: cube.obj", run.stdout)
        self.assertIn("photograph edited: edited.png", run.stdout)

    def test_applications_name_the_file_that_does_not_fit(self):
        frames.write_frame(self.folder)
        (self.folder / "edits.json").write_text(json.dumps({"edits": [{"id": 99, "remove": True}]}))
        (self.folder / "millimetres.xyz").write_text("".join(f"{200 * (k % 7)} {300 * (k % 5)} {250 * (k % 3)}\n" for k in range(100)))
        for flag, file, said in (("--edit", "edits.json", "edits[0].id: found 99"), ("--complete", "millimetres.xyz", "size: found")):
            run = self.unseen("cuboids", "frame.json", "-o", "out", flag, file)
            self.assertEqual(run.returncode, 3, run.stderr)
            self.assertIn(f"{file}: {said}", run.stderr)

    def test_writes_all_files_and_they_agree(self):
        self.solve()
        out = self.folder / "out"
        self.assertEqual(set(contents(out)), FILES)
        result = self.result()
        schema = json.loads((SOURCE / "docs/schema/cuboids.result.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.Draft202012Validator(schema).validate(result)
        self.assertEqual(result["summary"]["status"], "solved")
        boxes = result["cuboids"]
        self.assertGreater(len(boxes), 0)
        for box in boxes:
            self.assertAlmostEqual(box["mass"], box["density"] * numpy.prod(box["size"]), 9)
            self.assertTrue(numpy.allclose(numpy.array(box["axes"]) @ numpy.array(box["axes"]).T, numpy.eye(3), atol=1e-6))

        names = [node["name"] for node in glb_json(out / "scene.glb")["nodes"]]
        self.assertEqual(len(names), len(set(names)))
        self.assertIn("points", names)
        for box in boxes:
            self.assertTrue(any(name.startswith(f"box {box['id']}") for name in names), names)
        geoms = xml.etree.ElementTree.parse(out / "scene.xml").findall(".//geom[@mass]")
        self.assertEqual(sorted(float(g.get("mass")) for g in geoms), sorted(float(f"{b['mass']:.9g}") for b in boxes))
        links = {link.get("name") for link in xml.etree.ElementTree.parse(out / "scene.urdf").findall("link")}
        self.assertEqual(links, {"world"} | {f"box_{b['id']}" for b in boxes} | {f"support_{s['id']}" for s in result["supports"]})

    def test_the_page_agrees_with_the_result(self):
        self.solve()
        result = self.result()
        scene, = scenes_of(self.folder / "out/report.html")
        self.assertEqual(scene.header["command"], "unseen cuboids frame.json -o out")
        self.assertEqual(scene.header["summary"], result["summary"])
        boxes = scene["boxes"]
        centers = scene.array(boxes["centers"]) + scene.header["offset"]
        self.assertTrue(numpy.allclose(centers, [b["center"] for b in result["cuboids"]], atol=1e-6))
        self.assertTrue(numpy.allclose(scene.array(boxes["sizes"]), [b["size"] for b in result["cuboids"]], atol=1e-6))
        half, seen = scene.array(boxes["sizes"]) / 2, scene.array(boxes["seen"])
        self.assertTrue((seen[:, :3] >= -half - 1e-6).all() and (seen[:, 3:] <= half + 1e-6).all())
        self.assertEqual(len(scene["contacts"]["edge_names"]), len(result["contacts"]))
        self.assertEqual(len(scene["contacts"]["node_names"]), len(result["cuboids"]) + len(result["supports"]))
        carried = scene.array(scene["contacts"]["vectors"])
        total = sum((numpy.sum(c["forces"], 0) for c in result["contacts"] if c["forces"] and c["a"] in {s["id"] for s in result["supports"]}),
                    numpy.zeros(3))
        of_supports = [k for k, edge in enumerate(scene.array(scene["contacts"]["edges"])) if edge[0] < len(result["supports"])]
        self.assertTrue(numpy.allclose(carried[of_supports].sum(0), total, atol=1e-4))

        depth, owner, _ = frames.render()
        clouds = [s for s in scene.header["structures"] if s["kind"] == "points"]
        self.assertEqual(sum(cloud["positions"]["count"] for cloud in clouds), int(numpy.isfinite(depth).sum()))
        colors = {tuple(c) for cloud in clouds for c in scene.array(cloud["quantities"][0]["array"])}
        self.assertEqual(colors, {frames.COLORS[i] for i in set(owner[owner >= 0])})
        camera = scene["camera"]
        self.assertTrue(numpy.allclose(numpy.reshape(camera["T_world_camera"], (4, 4)), result["T_world_camera"]))
        picture = scene.array(scene[camera["image"]]["data"]).tobytes()
        self.assertEqual((picture[:3], picture[-2:]), (b"\xff\xd8\xff", b"\xff\xd9"))

    def test_prints_a_few_friendly_lines(self):
        run = self.solve()
        self.assertTrue(3 <= len(run.stdout.splitlines()) <= 6, run.stdout)
        for word in ("box", "contact", "out/report.html"):
            self.assertIn(word, run.stdout)
        self.assertEqual(self.unseen("cuboids", "frame.json", "-o", "out", "--quiet").stdout, "")
        run = self.unseen("cuboids", "frame.json", "-o", "out", "--json")
        self.assertEqual(json.loads(run.stdout), self.result()["summary"])

    def test_no_report(self):
        self.solve("--no-report")
        self.assertEqual(set(contents(self.folder / "out")), FILES - {"report.html"})

    def test_options_reach_the_result(self):
        self.solve("--density", "450", "--mu", "0.5")
        result = self.result()
        self.assertEqual((result["options"]["density"], result["options"]["friction"]), (450, 0.5))
        self.assertEqual({box["density"] for box in result["cuboids"]}, {450})
        geom = xml.etree.ElementTree.parse(self.folder / "out/scene.xml").find("default/geom")
        self.assertEqual(float(geom.get("friction").split()[0]), 0.5)

    def test_given_supports(self):
        up = frames.render()[2]
        text = ",".join(f"{c:.9f}" for c in up) + ",-0.8,desk"
        self.solve("--support", text)
        result = self.result()
        self.assertEqual(result["options"]["support"], text)
        self.assertEqual([s["kind"] for s in result["supports"]], ["desk"])
        self.assertTrue(numpy.allclose(numpy.array(result["T_world_camera"])[2, :3], up, atol=1e-6))
        self.assertAlmostEqual(result["T_world_camera"][2][3], 0.8, 6)

    def test_a_folder_with_usual_names(self):
        frames.write_frame(self.folder / "scan")
        frame = json.loads((self.folder / "scan/frame.json").read_text())
        (self.folder / "scan/frame.json").unlink()
        (self.folder / "scan/intrinsics.json").write_text(json.dumps(frame["camera"]))
        run = self.unseen("cuboids", "scan", "-o", "out")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("Boxes of scan", (self.folder / "out/report.html").read_text())

    def test_view_writes_the_page_again(self):
        self.solve("--density", "400")
        before = (self.folder / "out/report.html").read_bytes()
        run = self.unseen("view", "out")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        first, = scenes_of(self.folder / "out/report.html")
        self.assertEqual(first.header["command"], "unseen cuboids frame.json -o out --density 400")
        self.assertEqual((self.folder / "out/report.html").read_bytes(), before)
        (self.folder / "elsewhere").mkdir()
        run = self.unseen("view", "../out", cwd=self.folder / "elsewhere")
        self.assertEqual((run.returncode, run.stderr), (0, ""), "from another folder the frame is found, too")
        self.assertEqual(scenes_of(self.folder / "out/report.html")[0].header["structures"], first.header["structures"])
        (self.folder / "depth.png").unlink()
        run = self.unseen("view", "out")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("without depth and photograph", run.stderr)
        again, = scenes_of(self.folder / "out/report.html")
        self.assertEqual({s["id"] for s in again.header["structures"]}, {"boxes", "contacts", "supports"})
        self.assertEqual(again["boxes"], first["boxes"])


class Check(CliTest):
    """unseen cuboids --check: a block of 2 m on a beam of 4 m, at its middle and over its end."""

    def assembly(self, x, **more):
        blocks = [{"id": "beam", "center": [0, 0, 0.5], "size": [4, 1, 1]}, {"id": 7, "center": [x, 0, 1.5], "size": [2, 1, 1]}]
        (self.folder / "a.json").write_text(json.dumps({"blocks": blocks, **more}))

    def test_verdicts_and_exit_codes(self):
        self.assembly(0.5)
        run = self.unseen("cuboids", "--check", "a.json", "--support", "beam")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("stands", run.stdout)
        self.assembly(2.2)  # its centre is beyond the beam's end at 2 m
        run = self.unseen("cuboids", "--check", "a.json", "--support", "beam")
        self.assertEqual((run.returncode, run.stderr), (4, ""))
        self.assertIn("falls; what begins to move: 7\n", run.stdout)

    def test_json(self):
        self.assembly(0.5, supports=["beam"])
        run = self.unseen("cuboids", "--check", "a.json", "--mu", "0.6", "--density", "2400", "--json")
        verdict = json.loads(run.stdout)
        self.assertEqual((verdict["stable"], verdict["friction"], verdict["supports"]), (True, 0.6, ["beam"]))
        # Pushed aside the block slides at 0.6 g; across the beam (half width and half height 0.5 m) it would tip at 1 g.
        self.assertAlmostEqual(verdict["margin"], 0.6, 2)
        self.assertAlmostEqual(verdict["friction_needed"], 0, 2)
        weight = numpy.sum([c["forces"] for c in verdict["contacts"]], (0, 1))
        sign = 1 if verdict["contacts"][0]["b"] == "7" else -1
        self.assertTrue(numpy.allclose(sign * weight, [0, 0, 2 * 2400 * 9.81], rtol=1e-3, atol=1), weight)
        self.assembly(2.2, supports=["beam"])
        falling = json.loads(self.unseen("cuboids", "--check", "a.json", "--json").stdout)
        self.assertEqual([c["block"] for c in falling["collapse"]], ["7"])

    def test_up_decides(self):
        self.assembly(0.5)
        self.assertEqual(self.unseen("cuboids", "--check", "a.json", "--support", "beam", "--up", "0,0,-1").returncode, 4)
        self.assertEqual(self.unseen("cuboids", "--check", "a.json", "--support", "beam", "--up=-0.5,0,1").returncode, 0)  # 26.6° < atan 0.7
        self.assertEqual(self.unseen("cuboids", "--check", "a.json", "--support", "beam", "--up=-0.8,0,1").returncode, 4)

    def test_ctrl_c_ends_a_large_one(self):
        """A wall of 900 bricks takes much longer than this test waits."""
        bricks = [{"id": f"{row}_{i}", "center": [0.2 * i + 0.1 * (row % 2), 0, 0.05 + 0.1 * row], "size": [0.2, 0.1, 0.1]}
                  for row in range(30) for i in range(30)]
        ground = {"id": "ground", "center": [0, 0, -0.5], "size": [100, 100, 1]}
        (self.folder / "wall.json").write_text(json.dumps({"blocks": [ground, *bricks], "supports": ["ground"]}))
        run = subprocess.Popen([PROGRAM, "cuboids", "--check", "wall.json"], cwd=self.folder, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
        self.addCleanup(run.stdout.close)
        self.addCleanup(run.stderr.close)
        time.sleep(4)
        run.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(timeout=10), 130)

    def test_refused(self):
        self.assembly(0.5)
        self.assert_one_line(self.unseen("cuboids", "--check", "a.json"), 2, "--support ID")
        self.assert_one_line(self.unseen("cuboids", "--check", "a.json", "--support", "roof"), 3, "roof")
        self.assert_one_line(self.unseen("cuboids", "--check", "a.json", "--support", "beam", "--up", "0,0,0"), 2, "up")
        self.assert_one_line(self.unseen("cuboids", "--check", "a.json", "frame.json"), 2, "FRAME")
        self.assert_one_line(self.unseen("cuboids", "frame.json", "-o", "out", "--up", "0,0,1"), 2, "--check")
        self.assert_one_line(self.unseen("cuboids", "--check", "none.json", "--support", "beam"), 3, "none.json")
        (self.folder / "a.json").write_text("[" * 100000)
        self.assert_one_line(self.unseen("cuboids", "--check", "a.json", "--support", "beam"), 3, "a.json")


class Refused(CliTest):
    """Exit code 3 (2 for the command line), one line, nothing written, and an earlier result stays."""

    def setUp(self):
        super().setUp()
        (self.folder / "out").mkdir()
        (self.folder / "out/result.json").write_text("an earlier result")

    def assert_refused(self, *words, name="frame.json", arguments=(), code=3):
        before = contents(self.folder)
        run = self.unseen("cuboids", name, "-o", "out", *arguments, timeout=60)
        self.assert_one_line(run, code, *words)
        self.assertEqual(contents(self.folder), before)

    def test_no_depth(self):
        self.assert_refused("nowhere.json", name="nowhere.json")
        frames.write_frame(self.folder, depth=None)
        self.assert_refused("frame.json", "depth")
        frames.write_frame(self.folder, depth="gone.png")
        self.assert_refused("frame.json", "gone.png")
        self.assert_refused("depth.png", name="out")

    def test_nothing_measured(self):
        frames.write_frame(self.folder)
        (self.folder / "depth.png").write_bytes(frames.png(numpy.zeros((48, 64), numpy.uint16)))
        (self.folder / "color.png").write_bytes(frames.png(numpy.zeros((48, 64, 3), numpy.uint8)))
        self.assert_refused("depth.png", "none of 3072 pixels")

    def test_truncated_tiff(self):
        frames.write_frame(self.folder, depth="depth.tif")
        (self.folder / "depth.tif").write_bytes(frames.tiff(numpy.ones((48, 64), numpy.uint16))[:-3000])
        self.assert_refused("depth.tif", "broken or truncated")

    def test_wrong_units(self):
        frames.write_frame(self.folder, depth_scale=1)
        self.assert_refused("depth.png", "a scene of", "depth_scale 1000")
        frames.write_frame(self.folder, depth_scale=1e6)
        self.assert_refused("depth.png", "a scene of 0.00", "depth_scale 1000")

    def test_other_sizes(self):
        frames.write_frame(self.folder)
        (self.folder / "color.png").write_bytes(frames.png(numpy.zeros((48, 64, 3), numpy.uint8)))
        self.assert_refused("color.png", "64 x 48", "320 x 240")

    def test_intrinsics(self):
        frames.write_frame(self.folder, camera=None)
        self.assert_refused("frame.json", "camera", "fx, fy, cx and cy")
        frames.write_frame(self.folder, camera={"fx": 525, "fy": 525, "cx": 320})
        self.assert_refused("frame.json", "cy is missing")

    def test_hints(self):
        frames.write_frame(self.folder, up=[0, -3, 0])
        self.assert_refused("frame.json", "up", "length 3")
        frames.write_frame(self.folder, supports=[{"normal": [0, 0, 0], "offset": 1, "kind": "desk"}])
        self.assert_refused("frame.json", "supports[0].normal")
        frames.write_frame(self.folder, strokes=[{"label": "a", "points": [[400, 3]]}])
        self.assert_refused("frame.json", "strokes[0].points[0]", "(400, 3)")

    def test_hostile(self):
        frames.write_frame(self.folder)
        for text in ("", "{", "[" * 100000, '{"depth": {}}', '{"depth": "depth.png", "camera": 1e999}', "\x00\x01"):
            with self.subTest(text=text[:20]):
                (self.folder / "frame.json").write_text(text)
                self.assert_refused("frame.json")

    def test_usage(self):
        frames.write_frame(self.folder)
        for arguments in (("--support", "0,0,0,1"), ("--support", "up"), ("--friction", "-1"), ("--mu", "x"), ("--mu", "0.5", "--friction", "0.6"), ("--boxes", "3")):
            with self.subTest(arguments=arguments):
                self.assert_refused(arguments=arguments, code=2)
        self.assert_one_line(self.unseen("cuboids", "frame.json"), 2, "-o OUT")
        self.assert_one_line(self.unseen("cuboids", "-o", "out"), 2, "FRAME")
        help_text = self.unseen("cuboids", "--help").stdout
        for flag in ("--friction", "--density", "--support", "--no-report", "--check"):
            self.assertIn(flag, help_text)


if __name__ == "__main__":
    unittest.main()
