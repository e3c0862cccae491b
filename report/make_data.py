#!/usr/bin/env python3
"""Turns report/data/*.csv into what the report's sources read: measured.tex (numbers by name, for \\measured{...}), rows of
tables (*.tex) and plot data (*.csv without quotes, which pgfplots cannot read).   report/make_data.py OUT_FOLDER

Of a series that was measured more than once the newest counts. A file that does not exist yet leaves its numbers out, and
the sources leave out what needs them (\\ifmeasured). Expected of the files that are optional:
  compare.csv         from tools/compare_scenes
  implicit_bench.csv  date,commit,command,device,backend,integrator,points,steps,ms: wall time of a frame of 1/60 s
  resolution.csv      date,commit,command,case,points,value,unit,demand: what should not change with the resolution
  rest_shapes.csv     date,commit,command,scene,ks,time_step,centroid_mm,lowest_mm,demand: how far the rest shape of `implicit`
                      at a time step [s] lies from that of small steps of `verlet`
"""
import csv, math, pathlib, re, sys
from collections import defaultdict

root = pathlib.Path(__file__).resolve().parent.parent
out = pathlib.Path(sys.argv[1])
measured = {}


def rows_of(name):
    path = root / "report/data" / name
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def write(name, lines):
    (out / name).write_text("\n".join(lines) + "\n")


def escaped(text):
    for sign in "&%$#_{}":
        text = text.replace(sign, "\\" + sign)
    return text.replace("^", r"\textasciicircum{}").replace("<=", r"$\le$").replace("+-", r"$\pm$")


# Exponents of one figure: l^3.
def raised(text):
    return re.sub(r"\\textasciicircum\{\}(\d)", r"$^\1$", text)


def power(value, digits=1):
    """2.1e-09 as $2.1\\cdot10^{-9}$."""
    if value == 0:
        return "0"
    mantissa, exponent = f"{value:.{digits}e}".split("e")
    if float(mantissa) == 1 and digits <= 1:
        return f"$10^{{{int(exponent)}}}$" if value > 0 else f"$-10^{{{int(exponent)}}}$"
    return f"${mantissa}\\cdot10^{{{int(exponent)}}}$"


def number(text, digits=7):
    value = float(text)
    if value != 0 and (abs(value) < 1e-3 or abs(value) >= 1e6):
        return power(value)
    shown = f"{value:.{digits}g}"
    return f"${shown}$" if value < 0 else shown


def thousands(value):
    return f"{int(value):,}".replace(",", "\\,")


# The validation table, for the appendix, and how much of each tolerance was used, for the plot.
TITLES = {"error of an implicit step over that of the inertial guess": "error of an implicit step over its guess's",
          "fold, twist, stack, funnel: crossings": "crossings: fold, twist, stack, funnel",
          "strain limit 10 %, soft swinging sheet": "strain limit of 10 %, soft sheet",
          "hash candidates against brute force": "hash against brute force",
          "flat sheet falling, quadratic drag": "flat sheet falling, drag",
          "pins; flat sheet without forces": "pins; sheet without forces",
          "cantilever strip, w l^3/B = 4": "cantilever strip"}


def title_of(row):
    return TITLES.get(row, row)


def shown_demand(demand):
    sign, bound = re.fullmatch(r"(\+-|<=)(.*)", demand).groups()
    if float(bound) == 0:
        return r"$\le0$" if sign == "<=" else "0"
    return (r"$\pm$" if sign == "+-" else r"$\le$") + number(bound, 2)


def shown_case(case):
    case = case.replace("e-0", "e-").replace(" x ", r"$\times$").replace(", newton_steps 4, cg_iterations 10", ", defaults")
    case = re.sub(r"(\d+)x(\d+) points", r"\1$\\times$\2", case)
    parts = re.split(r"(\$[^$]*\$)", case)
    shown = "".join(part if part.startswith("$") else escaped(part) for part in parts)
    return raised(shown)


def validation():
    figures = rows_of("validation.csv")
    by_row = defaultdict(list)
    for figure in figures:
        by_row[figure["row"]].append(figure)
    lines, notes = [], []
    for row, members in by_row.items():
        suites = sorted({re.search(r"gtest_filter=(\w+)\.", f["command"]).group(1) for f in members if "gtest_filter" in f["command"]})
        source = " ".join(rf"\texttt{{{suite}}}" for suite in suites) or r"\texttt{tools/validate crossings}"
        lines.append(rf"\multicolumn{{6}}{{@{{}}l}}{{\rule{{0pt}}{{2.7ex}}\textbf{{{raised(escaped(row[0].upper() + row[1:]))}}}\quad {source}}}\\*")
        pairs = defaultdict(dict)
        for figure in members:
            own_expected = figure["expected"] if row not in ("Cusick drape",) else figure["case"]
            pairs[figure["case"], own_expected][figure["precision"]] = figure
        for (case, _), pair in pairs.items():
            one = next(iter(pair.values()))
            unit = f" [{escaped(one['unit'])}]" if one["unit"] else ""
            cells = [shown_case(case) + unit, number(one["expected"])]
            for precision in ("double", "binary32"):
                if precision not in pair:
                    cells += ["", ""]
                    continue
                figure = pair[precision]
                value = number(figure["measured"])
                if figure["met"] != "yes":
                    note = figure["note"] or "no cause known"
                    if note not in notes:
                        notes.append(note)
                    value = rf"\textcolor{{rust}}{{{value}}}\rlap{{\textsuperscript{{{chr(97 + notes.index(note))}}}}}"
                cells += [value, shown_demand(figure["demand"])]
            lines.append("~~" + " & ".join(cells) + r"\\")
    write("validation.tex", lines)
    write("validation_notes.tex", [rf"\textsuperscript{{{chr(97 + i)}}}~{escaped(note)}." for i, note in enumerate(notes)])
    measured["validation count"] = str(len(figures))
    measured["validation unmet"] = str(sum(f["met"] != "yes" for f in figures))
    measured["validation rows"] = str(len(by_row))
    measured["validation commit"] = next(f["commit"] for f in figures if "gtest_filter" in f["command"])
    plot_validation(by_row)

    def value(row, case, precision, digits):
        found = [f for f in figures if f["row"] == row and f["case"] == case and f["precision"] == precision]
        assert found, f"validation.csv lacks {row}, {case}, {precision}"
        return f"{float(found[0]['measured']):.{digits}f}", f"{float(found[0]['expected']):.{digits}f}"

    cantilever, slope = "cantilever strip, w l^3/B = 4", "slope with friction mu = .5"
    measured["cantilever ratio a"] = value(cantilever, "error ratio, N = 8 to 16", "double", 2)[0]
    measured["cantilever ratio b"] = value(cantilever, "error ratio, N = 16 to 32", "double", 2)[0]
    measured["order verlet"] = value("order of convergence", "verlet", "double", 3)[0]
    measured["order euler"] = value("order of convergence", "symplectic euler", "double", 3)[0]
    case = "way in 2 s, 0.5 degrees above the critical angle, on a plane"
    measured["slide measured"], measured["slide expected"] = value(slope, case, "binary32", 4)
    limits = [f for f in figures if f["row"].startswith("strain limit")]
    if limits:
        worst = max(float(f["measured"]) for f in limits)
        measured["strain limit note"] = (f"On a soft swinging sheet with a limit of 10\\,\\% the largest stretch after any step "
                                         f"was {100 * worst:.1f}\\,\\% (appendix).")
    errors = [f for f in figures if f["row"].startswith("error of an implicit step")]
    if errors:
        implicit_errors(errors)


# Error against tolerance; what differs by nothing at all is put at the left edge.
def plot_validation(by_row):
    names = list(by_row)
    lines = {precision: ["y,x"] for precision in ("double", "binary32")}
    for place, row in enumerate(names):
        for figure in by_row[row]:
            bound = float(re.fullmatch(r"(?:\+-|<=)(.*)", figure["demand"]).group(1))
            error = float(figure["measured"]) - float(figure["expected"])
            error = max(error, 0) if figure["demand"].startswith("<=") else abs(error)
            used = error / bound if bound > 0 else (0 if error == 0 else math.inf)
            y = len(names) - place + (0.17 if figure["precision"] == "double" else -0.17)
            lines[figure["precision"]].append(f"{y},{min(max(used, 1e-13), 10):.4g}")
    for precision, points in lines.items():
        write(f"validation_{precision}.csv", points)
    measured["validation labels"] = ",".join("{" + escaped(title_of(row)) + "}" for row in reversed(names))
    measured["validation places"] = ",".join(str(k + 1) for k in range(len(names)))
    measured["validation top"] = f"{len(names) + 0.7}"


# Rows "40 units, 64^2, frame 20".
def implicit_errors(errors):
    table = defaultdict(dict)
    for figure in errors:
        match = re.fullmatch(r"(\d+) units, (\d+)\^2, frame (\d+)", figure["case"])
        if match:
            units, points, frame = map(int, match.groups())
            table[points, frame][units] = figure
    if not table:
        return
    units = sorted({u for row in table.values() for u in row})
    lines = []
    for (points, frame), row in sorted(table.items()):
        cells = [f"${points}^2$, frame {frame}"]
        for u in units:
            cells.append(f"{float(row[u]['measured']):.3f}" if u in row else "")
        lines.append(" & ".join(cells) + r"\\")
    write("implicit_errors.tex", lines)
    measured["implicit error rows"] = str(len(lines))
    measured["implicit error head"] = " & ".join(["sheet"] + [f"{u} units" for u in units])
    measured["implicit error columns"] = "l" + "r" * len(units)


def materials():
    text = (root / "src/cloth/material.cpp").read_text()
    keys = "density stretch shear bend damping thickness friction".split()
    lines = []
    for name, body in re.findall(r'\{"(\w+)",\s*\{(\.density.*?)\}\}', text, re.S):
        values = {key: value.replace("'", "") for key, value in re.findall(r"\.(\w+) = ([\d'.e+-]+)", body)}
        assert set(values) == set(keys), f"material.cpp: {name} has {values}"
        cells = [name]
        for key in keys:
            value = float(values[key])
            cells.append(f"{1000 * value:g}" if key == "thickness" else power(value, 1 if f"{value:.1e}"[2] != "0" else 0) if key == "bend"
                         else thousands(value) if value >= 1000 else f"{value:g}")
        lines.append(" & ".join(cells) + r"\\")
    assert len(lines) >= 6
    write("materials.tex", lines)


# Robust self-collision: a line a scene and size, over all its seeds.
def crossings():
    rows = rows_of("crossings.csv")
    robust = [row for row in rows if row["mode"] == "robust"]
    groups = defaultdict(list)
    for row in robust:
        columns, lines = map(int, row["points"].split("x"))
        groups[row["scene"], columns * lines > 10000].append(row)
    lines = []
    for scene in dict.fromkeys(row["scene"] for row in robust):
        cells = [rf"\key{{{escaped(scene)}}}"]
        for large in (False, True):
            runs = groups.get((scene, large), [])
            if not runs:
                cells += [""] * 4
                continue
            nearest = min(float(r["smallest_distance"]) / float(r["needed_distance"]) for r in runs)
            cells += [runs[0]["points"].replace("x", r"$\times$"), str(len(runs)), str(max(int(r["crossings"]) for r in runs)), f"{nearest:.2f}"]
        lines.append(" & ".join(cells) + r"\\")
    write("crossings.tex", lines)
    measured["crossing runs"] = str(len(robust))
    measured["crossing worst"] = str(max(int(row["crossings"]) for row in robust))
    measured["crossing neighbours"] = str(max(int(row["neighbour_crossings"]) for row in robust))
    measured["crossing frames"] = thousands(sum(int(row["frames"]) for row in robust))
    measured["crossing sound"] = str(sum(row["contact_sound"] == "True" for row in robust))
    averaged = [row for row in rows if row["mode"] == "averaged"]
    if averaged:
        measured["averaged crossings"] = ", ".join(f"{thousands(int(r['crossings']))} in \\key{{{r['scene']}}}" for r in averaged)


# The newest run of `clothsim bench` that meets a demand on its cases.
def newest(rows, wanted):
    runs = defaultdict(list)
    for row in rows:
        runs[row["date"], row["commit"], row["command"]].append(row)
    fitting = [(key, run) for key, run in runs.items() if wanted(run)]
    return fitting[-1] if fitting else (None, [])


def commit_of(key):
    return escaped(f"commit {key[1]}, {key[0]}")


def speeds():
    rows = rows_of("bench.csv")

    def rate(run, backend, n, suffix):
        found = [r for r in run if r["case"] == f"{backend} {n}x{n}{suffix}" and r["unit"] == "particle-steps/s"]
        return float(found[-1]["value"]) / 1e6 if found else None

    def sizes_of(run):
        return sorted({int(m.group(1)) for r in run if (m := re.fullmatch(r"cpu (\d+)x\1", r["case"]))})

    key, run = newest(rows, lambda run: len(sizes_of(run)) >= 4)
    lines = ["n,cpu,gpu,cpulimit,gpulimit"]
    for n in sizes_of(run):
        values = [rate(run, backend, n, suffix) for suffix in ("", " limiter") for backend in ("cpu", "gpu")]
        lines.append(",".join([str(n)] + [f"{v:.4g}" for v in values]))
    write("speed.csv", lines)
    measured["speed sizes"] = ",".join(map(str, sizes_of(run)))
    measured["speed command"] = escaped(re.sub(r"(--resolution \S+ ?)+", lambda m: " ".join(m.group(0).split()) + " ", key[2]).strip()).replace("--", "-{}-")
    measured["speed commit"] = commit_of(key)
    measured["speed device"] = escaped(next(r["device"] for r in run if r["case"].startswith("gpu ")))

    n = 256
    key, run = newest(rows, lambda run: rate(run, "gpu", n, " limiter robust self-collision") and run[0]["scene"] == "pinned2")
    case = f"gpu {n}x{n} limiter robust self-collision, pass "
    passes = [(r["case"].removeprefix(case), float(r["value"])) for r in run if r["case"].startswith(case)]
    write("passes.csv", ["y,ms"] + [f"{len(passes) - k},{ms:.4g}" for k, (_, ms) in enumerate(passes)])
    measured["pass labels"] = ",".join("{" + escaped(name.replace("step (forces, integrate)", "forces, integrate").replace("self-collision, ", "")) + "}"
                                       for name, _ in reversed(passes))
    measured["pass places"] = ",".join(str(k + 1) for k in range(len(passes)))
    measured["pass top"] = f"{len(passes) + 0.6}"
    measured["pass command"] = escaped(key[2]).replace("--", "-{}-")
    measured["pass commit"] = commit_of(key)
    for backend in ("cpu", "gpu"):
        for suffix, name in (("", "plain"), (" limiter", "limiter"), (" limiter averaged self-collision", "averaged"), (" limiter robust self-collision", "robust")):
            measured[f"{backend} {name}"] = f"{rate(run, backend, n, suffix):.0f}" if rate(run, backend, n, suffix) >= 10 else f"{rate(run, backend, n, suffix):.1f}"

    key, run = newest(rows, lambda run: any(r["case"].startswith("draw fabric") for r in run))
    for shader in ("fabric", "phong"):
        found = {r["case"]: float(r["value"]) for r in run if r["case"].startswith(f"draw {shader}, 1 samples")}
        measured[f"draw {shader}"] = f"{found[f'draw {shader}, 1 samples']:.0f}"
        for name in ("scene", "shadows", "resolve", "normals"):
            ms = found[f"draw {shader}, 1 samples, pass {name}"]
            measured[f"draw {shader} {name}"] = f"{ms:.0f}" if ms >= 1 else f"{ms:.1f}"
    measured["draw command"] = escaped(key[2]).replace("--", "-{}-")
    measured["draw commit"] = commit_of(key)

    key, run = newest(rows, lambda run: any("largest demo" in r["case"] for r in run))
    for backend in ("cpu", "gpu"):
        found = {r["case"]: r["value"] for r in run}
        measured[f"demo {backend}"] = found[f"{backend}, largest demo at 30 frames/s, not drawn"]
        measured[f"demo {backend} drawn"] = found[f"{backend}, largest demo at 30 frames/s, drawn at 640x360"]
    measured["demo commit"] = commit_of(key)


def exports():
    rows = rows_of("exports.csv")
    for name, start in (("blender", "Blender"), ("usd", "usd-core")):
        found = [row for row in rows if row["tool"].startswith(start)]
        measured[f"export {name}"] = power(max(float(row["measured"]) for row in found))
        measured[f"export {name} tool"] = found[-1]["tool"]
    torn = [row for row in rows if row["unit"] == "files"]
    measured["export torn"] = str(int(sum(float(row["measured"]) for row in torn)))


def comparison():
    rows = rows_of("compare.csv")
    if not rows:
        return
    lines = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        of_scene = [row for row in rows if row["scene"] == scene]
        cells = [rf"\key{{{escaped(scene)}}}", thousands(of_scene[0]["particles"])]
        for implicit in (False, True):
            row = next((r for r in of_scene if (r["integrator"] == "implicit") == implicit), None)
            cells += ([] if implicit else [row["integrator"]]) + ([thousands(row["steps"]), row["differing_floats"]] if row else ["", ""])
        lines.append(" & ".join(cells) + r"\\")
    write("compare.tex", lines)
    measured["compare rows"] = str(len(rows))
    measured["compare total steps"] = thousands(sum(int(row["steps"]) for row in rows))
    measured["compare total floats"] = thousands(sum(int(row["floats"]) * int(row["frames"]) for row in rows))
    measured["compare total differing"] = thousands(sum(int(row["differing_floats"]) for row in rows))
    measured["compare frames"] = rows[0]["frames"]
    measured["compare commit"] = commit_of([rows[-1]["date"], rows[-1]["commit"]])
    measured["compare device"] = escaped(rows[-1]["device"])


# What the lead's measurements of the implicit integrator add, once they are there.
def implicit():
    rows = rows_of("implicit_bench.csv")
    if rows:
        sizes = sorted({int(row["points"]) for row in rows})
        series = [(b, i) for b in ("cpu", "gpu") for i in ("implicit", "verlet")]
        found = {(row["backend"], row["integrator"], int(row["points"])): row for row in rows}  # the newest
        write("implicit_bench.csv", ["n," + ",".join(b + i for b, i in series)] + [
            ",".join([str(n)] + [found[b, i, n]["ms"] if (b, i, n) in found else "nan" for b, i in series]) for n in sizes])
        measured["implicit bench sizes"] = ",".join(map(str, sizes))
        both = [n for n in sizes if all(("cpu", i, n) in found for i in ("implicit", "verlet"))]
        measured["implicit bench ratios"] = ", ".join(
            f"{float(found['cpu', 'verlet', n]['ms']) / float(found['cpu', 'implicit', n]['ms']):.1f} at ${n}^2$" for n in both)
        measured["implicit bench command"] = escaped(rows[-1]["command"]).replace("--", "-{}-")
        measured["implicit bench commit"] = commit_of([rows[-1]["date"], rows[-1]["commit"]])
    rows = rows_of("resolution.csv")
    if rows:
        sizes = sorted({int(row["points"]) for row in rows})
        lines = []
        for case in dict.fromkeys(row["case"] for row in rows):
            of_case = {int(row["points"]): row for row in rows if row["case"] == case}
            one = next(iter(of_case.values()))
            unit = f" [{escaped(one['unit'])}]" if one["unit"] else ""
            lines.append(" & ".join([escaped(case) + unit] + [number(of_case[n]["value"], 5) if n in of_case else "" for n in sizes] +
                                    [escaped(one["demand"])]) + r"\\")
        write("resolution.tex", lines)
        measured["resolution head"] = " & ".join([""] + [f"${n}^2$" for n in sizes] + ["demand"])
        measured["resolution columns"] = "@{}l" + "r" * len(sizes) + "l@{}"
        measured["resolution commit"] = commit_of([rows[-1]["date"], rows[-1]["commit"]])
        measured["resolution command"] = escaped(rows[-1]["command"]).replace("--", "-{}-")
    rows = rows_of("rest_shapes.csv")
    if rows:
        steps = sorted({float(row["time_step"]) for row in rows})
        lines = []
        for scene, ks in dict.fromkeys((row["scene"], row["ks"]) for row in rows):
            cells = [rf"\key{{{escaped(scene)}}}", thousands(float(ks)) if float(ks) >= 1000 else f"{float(ks):g}"]
            for h in steps:
                here = [row for row in rows if (row["scene"], row["ks"], float(row["time_step"])) == (scene, ks, h)]
                cells.append(f"{float(here[-1]['centroid_mm']):.2f} / {float(here[-1]['lowest_mm']):.2f}" if here else "")
            lines.append(" & ".join(cells) + r"\\")
        write("rest_shapes.tex", lines)
        measured["rest shapes head"] = " & ".join(["scene", "$k_s$ or $k_\\mathrm{ref}$ [N/m]"] + [f"{h:.3g}\\,s" for h in steps])
        measured["rest shapes columns"] = "@{}ll" + "r" * len(steps) + "@{}"
        measured["rest shapes commit"] = commit_of([rows[-1]["date"], rows[-1]["commit"]])
        measured["rest shapes command"] = escaped(rows[-1]["command"]).replace("--", "-{}-")


def main():
    out.mkdir(parents=True, exist_ok=True)
    for part in (validation, materials, crossings, speeds, exports, comparison, implicit):
        part()
    dates = [row["date"] for name in ("bench.csv", "crossings.csv", "exports.csv") for row in rows_of(name)]
    measured["date"] = max(dates)
    write("measured.tex", [rf"\setmeasured{{{name}}}{{{value}}}" for name, value in measured.items()])


main()
