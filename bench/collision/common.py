# SPDX-License-Identifier: MIT
# Makes shots, reconstructs them with the built program, and measures the results: one row a case.
import csv
import json
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
UNSEEN = ROOT / "build/release/bin/unseen"
MEASURES = ["exit", "given", "c_true", "c", "c_error", "c_low", "c_high", "c_in", "m_true", "m", "m_error", "m_in",
            "ambiguous", "ambiguous_holds", "fits", "c_impact", "c_impact_error", "time_frames", "path", "rotation_deg", "seconds", "why"]

SAID = ["exit", "c_true", "c", "c_error", "c_in", "m_error", "ambiguous", "seconds", "why"]
GOLDEN = 0.5 * (5**0.5 - 1)
LEAST_TOLD = 1  # deg: what the solver is told of orientations that have less noise


@dataclass
class Bench:
    """Where and how cases run."""
    work: Path
    data: Path
    jobs: int = 1
    every: int = 1  # about one of so many cases

    def run(self, function, cases):
        """Rows of all cases, in their order. `function` takes this, and a case as keyword arguments."""
        cases = [case for i, case in enumerate(cases) if i * GOLDEN % 1 < 1 / self.every]  # spread over what a case has
        with ThreadPoolExecutor(self.jobs) as pool:
            yield from pool.map(lambda case: function(self, **case), cases)


def flags(options):
    """{"centroid_noise": 0.1} as ["--centroid-noise=0.1"]."""
    text = {True: "true", False: "false"}
    return [f"--{name.replace('_', '-')}={text.get(value, value) if isinstance(value, bool) else value}" for name, value in options.items()]


def command(*arguments):
    """Exit code (124: stopped after ten minutes, as of timeout(1)) and the last line of errors."""
    try:
        done = subprocess.run([UNSEEN, *map(str, arguments), "--quiet"], stderr=subprocess.PIPE, text=True, timeout=600, check=False)
    except subprocess.TimeoutExpired:
        return 124, ""
    return done.returncode, (done.stderr.strip().splitlines() or [""])[-1]


def read(path):
    return json.loads(Path(path).read_text()) if Path(path).exists() else None


def reconstruct(shot, out, options):
    """Exit code, seconds, and the result (none if the run failed)."""
    for name in ("result.json", "evaluation.json"):
        (out / name).unlink(missing_ok=True)
    start = time.monotonic()
    code, _ = command("collision", shot / "shot.json", "-o", out, "--no-report", "--no-overlay", "--threads=1", *flags(options))
    return code, time.monotonic() - start, read(out / "result.json")


def holds(value, truth):
    return "" if value is None or truth is None else int(value["low"] <= truth <= value["high"])


def number(value, digits=4):
    return "" if value is None else f"{value:.{digits}g}" if isinstance(value, float) else value


def scores(code, seconds, result, c_true, m_true):
    """The columns that need no truth of the motion. `given`: the program stands by a value of c."""
    row = {"exit": code, "given": 0, "c_true": number(c_true), "m_true": number(m_true), "seconds": f"{seconds:.1f}"}
    if result is None:
        return row
    c, m = result["restitution"], result["mass_ratio"]
    row["given"] = int(c is not None)
    if c:
        row |= {"c": number(c["value"]), "c_low": number(c["low"]), "c_high": number(c["high"]), "c_in": holds(c, c_true)}
        row["c_error"] = "" if c_true is None else number(abs(c["value"] - c_true))
    if m and m_true:
        row |= {"m": number(m["value"]), "m_error": number(abs(m["value"] / m_true - 1)), "m_in": holds(m, m_true)}
    row["ambiguous"] = len(result["ambiguous"])
    others = [other["restitution"] for other in result["ambiguous"] if other["restitution"] is not None]
    row["ambiguous_holds"] = int(any(abs(other - c_true) < 0.1 for other in others)) if c_true is not None else ""
    row["fits"] = int(result["fits"])
    row["why"] = "" if c else "; ".join(warning.removeprefix(result["input"]["path"] + ": ") for warning in result["summary"]["warnings"])
    if result["impacts"]:
        value = result["impacts"][0]["restitution"]["value"]  # also of a run that stands by no value
        row |= {"c_impact": number(value), "c_impact_error": "" if c_true is None else number(abs(value - c_true))}
    return row


def simulated(bench, name, synth, solve=None, disturb=None, **columns):
    """Makes and reconstructs one simulated case: its row. `columns` lead it. The solver is told how good the orientations are. `disturb` changes
    the list of sightings."""
    told = {"orientation_noise": max(LEAST_TOLD, synth.get("orientation_noise", 0))}
    return measured(bench, name, synth | {"video": False}, told | (solve or {}), columns, disturb)


def filmed(bench, name, synth, **columns):
    """The same from a film, with nothing told."""
    return measured(bench, name, synth, {}, columns)


def measured(bench, name, synth, solve, columns, disturb=None):
    shot, out = bench.work / name / "shot", bench.work / name / "out"
    code, error = command("synth", "collision", "-o", shot, *flags(synth))
    if code:
        raise RuntimeError(f"unseen synth collision {' '.join(flags(synth))}: {error}")
    if disturb:
        sightings = shot / "observations.json"
        sightings.write_text(json.dumps(disturb(read(sightings))))
    code, seconds, result = reconstruct(shot, out, solve)
    truth = read(shot / "truth.json")
    ratio = truth["mass_ratio"]
    row = {"case": name, **columns, "seed": synth["seed"], **scores(code, seconds, result, truth["restitution"]["value"], ratio and ratio["value"])}
    if result is not None and command("evaluate", "collision", out, "--truth", shot / "truth.json")[0] == 0:
        evaluation = read(out / "evaluation.json")
        turned = [motion["rotation_deg"] for motion in evaluation["motions"] if motion["rotation_deg"] is not None]
        row["time_frames"] = number(evaluation["time_frames"])
        row["path"] = number(max((motion["trajectory"] for motion in evaluation["motions"]), default=None))
        row["rotation_deg"] = number(max(turned, default=None))
    return row


def files(bench, name):
    """Folder of a case's shot, its truth, and its result (none if the run failed)."""
    shot = bench.work / name / "shot"
    return shot, read(shot / "truth.json"), read(bench.work / name / "out/result.json")


def floats(rows, column):
    return np.array([float(row[column]) for row in rows if row.get(column, "") != ""])


def summary(rows, what):
    """Medians of what was given, and the share of all rows within 0.10."""
    c, m = floats(rows, "c_error"), floats(rows, "m_error")
    ratios = len([row for row in rows if row["m_true"] != ""])
    text = f"{what}: {len(rows)} runs, {len(c)} values"
    if len(c):
        text += f"; c off by {np.median(c):.4f} (median), {c.max():.3f} (most), {100 * np.mean(c <= 0.1) * len(c) / len(rows):.0f} % within 0.10"
        text += f", interval holds {100 * floats(rows, 'c_in').mean():.0f} %"
    withheld = floats(rows, "c_impact_error")
    if len(withheld) > len(c):
        text += f"; with what was withheld c off by {np.median(withheld):.4f} (median of {len(withheld)})"
    if len(m):
        text += f"; m off by {np.median(m):.4f} (median), {100 * np.sum(m <= 0.1) / ratios:.0f} % within 10 %"
        text += f", interval holds {100 * floats(rows, 'm_in').mean():.0f} %"
    return text


def write(rows, fields, file):
    """CSV; a line a case to stderr. Returns the rows."""
    table, done = csv.DictWriter(file, fields, lineterminator="\n"), []
    table.writeheader()
    for row in rows:
        table.writerow(row)
        file.flush()
        done.append(row)
        said = [f"{key} {row[key]}" for key in SAID if row.get(key, "") != ""]
        print(f"{row['case']}: {', '.join(said)}", file=sys.stderr)
    return done
