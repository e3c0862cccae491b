#!/usr/bin/env python3
"""Turns report/data/*.csv into what the report's sources read: measured.tex (numbers by name, for \\measured{...}), rows of
tables (*.tex) and plot data (*.csv without quotes, which pgfplots cannot read).   report/make_data.py OUT_FOLDER

Of a series that was measured more than once the newest counts. A file that does not exist yet leaves its numbers out, and
the sources leave out what needs them (\\ifmeasured). Expected of the files that are optional:
  compare.csv         from tools/compare_scenes
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
          "cantilever strip, w l^3/B = 4": "cantilever strip",
          "standing and lying strips": "strips, standing and lying"}


def title_of(row):
    return TITLES.get(row, row)


def shown_demand(demand):
    sign, bound = re.fullmatch(r"(\+-|<=)(.*)", demand).groups()
    if float(bound) == 0:
        return r"$\le0$" if sign == "<=" else "0"
    return (r"$\pm$" if sign == "+-" else r"$\le$") + number(bound, 2)


def shown_case(case):
    case = case.replace("e-0", "e-").replace(" x ", r"$\times$").replace(", newton_steps 4, cg_iterations 10", r", $4\times10$")
    case = re.sub(r"(\d+)x(\d+) points", r"\1$\\times$\2", case)
    parts = re.split(r"(\$[^$]*\$)", case)
    shown = "".join(part if part.startswith("$") else escaped(part) for part in parts)
    return raised(shown)


# Rows of more figures are not listed in full.
LONGEST_ROW = 8


def demanded(figure):
    return re.fullmatch(r"(\+-|<=)(.*)", figure["demand"]).groups()


# How much of its tolerance a figure takes.
def used(figure):
    sign, bound = demanded(figure)[0], float(demanded(figure)[1])
    error = float(figure["measured"]) - float(figure["expected"])
    error = max(error, 0) if sign == "<=" else abs(error)
    return error / bound if bound > 0 else (0 if error == 0 else math.inf)


# Of each kind of figure in a row, by the words before its material and numbers, the case that takes most of its tolerance.
def worst_of(members):
    kinds = defaultdict(list)
    for figure in members:
        kinds[kind_of(figure["case"])].append(figure)
    worst = {max(kind, key=used)["case"] for kind in kinds.values()}
    return [figure for figure in members if figure["case"] in worst]


def kind_of(case):
    case = re.sub(r"\b(silk|cotton|denim|wool|jersey|rubber|paper)\b,? ?", "", case)
    case = re.split(r",| (?=of \d|\d+ degrees)| a leaning| of the buckling", case)[0]
    return re.sub(r"\d[\d.]*", "N", case)


def validation():
    figures = rows_of("validation.csv")
    by_row = defaultdict(list)
    for figure in figures:
        by_row[figure["row"]].append(figure)
    lines, notes = [], []
    for row, members in by_row.items():
        if row.endswith(": crossings"):
            continue  # the report has a table of these
        suites = sorted({re.search(r"gtest_filter=(\w+)\.", f["command"]).group(1) for f in members if "gtest_filter" in f["command"]})
        source = " ".join(rf"\texttt{{{suite}}}" for suite in suites) or r"\texttt{tools/validate crossings}"
        shown = members
        if len(members) > LONGEST_ROW:
            shown = worst_of(members)
            met = sum(figure["met"] == "yes" for figure in members)
            source += f"\\quad {len(members)} figures, {met} met; the worst:"
        lines.append(rf"\multicolumn{{6}}{{@{{}}l}}{{\rule{{0pt}}{{2.3ex}}\textbf{{{raised(escaped(row[0].upper() + row[1:]))}}}\quad {source}}}\\*")
        pairs = defaultdict(dict)
        for figure in shown:
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
                    note = figure["note"] or "no cause noted"
                    if note not in notes:
                        notes.append(note)
                    value = rf"\textcolor{{rust}}{{{value}}}\rlap{{\textsuperscript{{{chr(97 + notes.index(note))}}}}}"
                cells += [value, shown_demand(figure["demand"])]
            lines.append("~~" + " & ".join(cells) + r"\\")
    write("validation.tex", lines)
    write("validation_notes.tex", [rf"\textsuperscript{{{chr(97 + i)}}}~{escaped(note)}." for i, note in enumerate(notes)])
    measured["validation count"] = str(len(figures))
    measured["validation unmet"] = str(sum(f["met"] != "yes" for f in figures))
    unmet = {name: sum(f["row"] == row and f["met"] != "yes" for f in figures)
             for name, row in (("rubbing", "layers that rub"), ("edge", "fabric over an edge"))}
    unmet["other"] = sum(f["met"] != "yes" for f in figures) - sum(unmet.values())
    for name, count in unmet.items():
        measured[f"unmet {name}"] = str(count)
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
    measured["order bdf2"] = value("order of convergence", "bdf2", "double", 3)[0]
    measured["order implicit"] = value("order of convergence", "implicit euler", "double", 3)[0]
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
            y = len(names) - place + (0.17 if figure["precision"] == "double" else -0.17)
            lines[figure["precision"]].append(f"{y},{min(max(used(figure), 1e-13), 10):.4g}")
    for precision, points in lines.items():
        write(f"validation_{precision}.csv", points)
    measured["validation labels"] = ",".join("{" + escaped(title_of(row)) + "}" for row in reversed(names))
    measured["validation places"] = ",".join(str(k + 1) for k in range(len(names)))
    measured["validation top"] = f"{len(names) + 0.7}"


# Figures "40 units, 64^2, frame 20".
def implicit_errors(errors):
    for units in (40, 80):
        own = [float(figure["measured"]) for figure in errors if figure["case"].startswith(f"{units} units")]
        measured[f"implicit error {units}"] = f"{min(own):.2f} to {max(own):.2f}"


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


def commit_of(key):
    return escaped(f"commit {key[1]}, {key[0]}")


def mean(values):
    return sum(values) / len(values)


# Steps of explicit integrators: the CPU's as tools/bench --against wrote them last, those of the hardware GPU that was measured last.
def speeds():
    rows = [row for row in rows_of("bench_against.csv") if "integrator=verlet" in row["command"]]
    rows = [row for row in rows if (row["date"], row["now"]) == (rows[-1]["date"], rows[-1]["now"])]
    cpu = {row["case"]: 1000 * float(row["ms_now"]) for row in rows}
    gpu_rows = [row for row in rows_of("gpu.csv") if "llvmpipe" not in row["device"]]
    gpu_rows = [row for row in gpu_rows if row["commit"] == gpu_rows[-1]["commit"]]
    gpu = {row["case"]: row for row in gpu_rows}
    sizes = [sorted({int(match.group(1)) for case in cases if (match := re.fullmatch(pattern, case))})
             for cases, pattern in ((cpu, r"cpu (\d+)x\1"), (gpu, r"plain (\d+)x\1"))]
    lines = []
    for name, suffix, case in (("springs, bending", "", "plain"), ("and a strain limit", " limiter", "limiter"),
                               ("and averaged contact", " limiter averaged self-collision", None),
                               ("or robust contact", " limiter robust self-collision", "robust")):
        cells = [name] + [f"{cpu[f'cpu {n}x{n}{suffix}']:.0f}" for n in sizes[0]]
        cells += [f"{float(gpu[f'{case} {n}x{n}']['value']):.0f}" if case else "" for n in sizes[1]]
        lines.append(" & ".join(cells) + r"\\")
    write("speed.tex", lines)
    measured["speed head"] = " & ".join([""] + [f"${n}^2$" for side in sizes for n in side])
    measured["speed commit"] = commit_of([rows[-1]["date"], rows[-1]["now"]])
    measured["hardware commit"] = commit_of([gpu_rows[-1]["date"], gpu_rows[-1]["commit"]])
    measured["hardware equal"] = gpu["cases equal to the CPU in every bit"]["value"]
    measured["hardware cases"] = gpu["cases equal to the CPU in every bit"]["unit"].removeprefix("of ")
    measured["hardware demo 1024"] = f"{float(gpu['demo 1024x1024, a 30th of a second']['value']):.0f}"
    for name in ("implicit", "implicit with contact"):
        for n in sizes[1]:
            measured[f"hardware {name} {n}"] = f"{float(gpu[f'{name} {n}x{n}']['value']) / 1000 + 1e-9:.0f}"

    rows = rows_of("drawing_cost.csv")
    found = {(row["camera"], row["quality"]): float(row["processor_ms"]) for row in rows if row["program"] == "now" and row["scene"] == "demo"}
    for (camera, quality), ms in found.items():
        measured[f"draw {camera} {quality}"] = f"{ms:.0f}"
    measured["draw commit"] = commit_of([rows[-1]["date"], rows[-1]["commit"]])

    rows = [row for row in rows_of("demo_window.csv") if row["command"].startswith("clothsim")]
    rows = [row for row in rows if row["commit"] == rows[-1]["commit"]]
    by_size = defaultdict(list)
    for row in rows:
        by_size[int(re.search(r"--resolution (\d+)x", row["command"]).group(1))].append(row)
    shown = [(n, mean([float(r["frames_per_s"]) for r in of]), mean([float(r["of_real_time"]) for r in of])) for n, of in sorted(by_size.items())]
    measured["demo window"] = ", ".join(f"{fps:.0f} pictures a second and {100 * pace:.0f}\\,\\% of real time at ${n}^2$" for n, fps, pace in shown)
    measured["demo window commit"] = "commit " + rows[-1]["commit"]


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
        with_own = [r for r in of_scene if "solver.integrator" not in r["command"]]
        cells = [rf"\key{{{escaped(scene)}}}", thousands(of_scene[0]["particles"]), thousands(of_scene[0]["steps"])]
        cells += [str(len(with_own)), str(len(of_scene) - len(with_own))]
        lines.append(" & ".join(cells))
    half = (len(lines) + 1) // 2  # two scenes a line
    lines = [left + " & " + (lines[half + k] if half + k < len(lines) else "&&&&") + r"\\" for k, left in enumerate(lines[:half])]
    write("compare.tex", lines)
    measured["compare runs"] = str(len(rows))
    measured["compare scenes"] = str(len({row["scene"] for row in rows}))
    measured["compare total steps"] = thousands(sum(int(row["steps"]) for row in rows))
    measured["compare total floats"] = thousands(sum(int(row["floats"]) * int(row["frames"]) for row in rows))
    measured["compare total differing"] = thousands(sum(int(row["differing_floats"]) for row in rows))
    measured["compare frames"] = rows[0]["frames"]
    commits = list(dict.fromkeys(row["commit"].rstrip("+") for row in rows))
    measured["compare commit"] = f"commits {' and '.join(commits)}, {rows[-1]['date']}"


# Contact inside the step, as other programs see it.
def judges():
    rows = rows_of("contact_judges.csv")
    measured["judged runs"] = str(len(rows))
    measured["judged scenes"] = str(len({row["scene"] for row in rows}))
    measured["judged steps"] = thousands(sum(int(row["steps"]) for row in rows))
    measured["judged crossed"] = str(sum(int(row["ipctk_crossed_steps"]) for row in rows))
    measured["judged crossings"] = str(sum(int(row["cgal_crossings"]) for row in rows))
    measured["judged sound"] = str(sum(row["contact_sound"] == "True" for row in rows))
    measured["judged unsolved"] = str(sum(int(row["unsolved_steps"]) for row in rows))
    measured["judged commit"] = commit_of([rows[-1]["date"], rows[-1]["commit"]])
    rubbing = defaultdict(list)
    for row in rows_of("validation.csv"):
        if row["row"] == "layers that rub":
            rubbing[re.search(r"(\d+) steps a frame", row["case"]).group(1)].append(abs(float(row["measured"]) / float(row["expected"]) - 1))
    for steps, errors in rubbing.items():
        measured[f"rubbing cases {steps}"] = str(len(errors))
        measured[f"rubbing worst {steps}"] = f"{100 * max(errors):.0f}"
        measured[f"rubbing met {steps}"] = str(sum(error <= 0.02 for error in errors))


# Frames of 1/60 s in implicit steps at the defaults, what does not change with the resolution, and where cloth comes to rest.
def implicit():
    rows = [row for row in rows_of("implicit_cost.csv") if row["solver"] in ("implicit", "bdf2")]
    lines = []
    for n in sorted({int(row["points"]) for row in rows}):
        cells = [f"${n}^2$"]
        for solver in ("implicit", "bdf2"):
            row = next(r for r in rows if (r["solver"], r["backend"], int(r["points"])) == (solver, "cpu", n))
            cells += [f"{float(row['ms_a_frame']):.0f}", f"{float(row['newton_steps_a_step']):.1f}", f"{float(row['iterations_a_step']):.0f}",
                      row["unconverged_steps"]]
        lines.append(" & ".join(cells) + r"\\")
    write("implicit_cost.tex", lines)
    measured["implicit cost steps"] = rows[0]["steps_a_frame"]
    measured["implicit cost commit"] = commit_of([rows[-1]["date"], rows[-1]["commit"]])
    rows = rows_of("resolution.csv")
    if rows:
        sizes = sorted({int(row["points"]) for row in rows})
        measured["resolution sizes"] = f"${sizes[0]}^2$ to ${sizes[-1]}^2$"
        for name, case in (("sag", "hung, Y = 280 N/m: sag"), ("fall", "two corners: fall")):
            values = [float(row["value"]) for row in rows if row["case"] == case]
            measured[f"resolution {name}"] = f"{100 * (max(values) / min(values) - 1):.2f}"
        measured["resolution commit"] = commit_of([rows[-1]["date"], rows[-1]["commit"]])
        measured["resolution command"] = escaped(rows[-1]["command"]).replace("--", "-{}-")
    rows = rows_of("rest_shapes.csv")
    if rows:
        steps = sorted({float(row["time_step"]) for row in rows})
        measured["rest shapes steps"] = f"{steps[0]:g} to {steps[-1]:g}"
        measured["rest shapes scenes"] = str(len({(row["scene"], row["ks"]) for row in rows}))
        measured["rest shapes worst"] = f"{max(max(float(row['centroid_mm']), float(row['lowest_mm'])) for row in rows):.2f}"
        measured["rest shapes commit"] = commit_of([rows[-1]["date"], rows[-1]["commit"]])
        measured["rest shapes command"] = escaped(rows[-1]["command"]).replace("--", "-{}-")


def main():
    out.mkdir(parents=True, exist_ok=True)
    for part in (validation, materials, crossings, speeds, exports, comparison, judges, implicit):
        part()
    dates = [row["date"] for name in ("bench_against.csv", "compare.csv", "contact_judges.csv", "crossings.csv", "exports.csv")
             for row in rows_of(name)]
    measured["date"] = f"{min(dates)} to {max(dates)}"
    write("measured.tex", [rf"\setmeasured{{{name}}}{{{value}}}" for name, value in measured.items()])


main()
