"""What pictures cost and how much they flicker, beside those of an older commit (tools/validate drawing)."""
import csv, datetime, pathlib, shutil, statistics, subprocess, sys, tempfile

root = pathlib.Path(__file__).resolve().parent.parent.parent
before = "dac4331~1"  # before the cloth was drawn as a smooth surface
libraries = ("-lzip -lassimp -ltinyobjloader -lgmpxx -lmpfr -lgmp -ldl -lglfw -limgui -lstb -lEGL").split()

# Name, resolution, frames before the pictures.
scenes = [("pinned2", "-", 30), ("stack", "-", 30), ("demo", "96x96", 20), ("skirt", "-", 20)]
rounds, pictures = 3, 15

# A sheet at rest on a ball, from close up to far away: target and eye.
scene, points, settling_frames, frames = "report/data/ball.json", "65x65", 60, 60
distances = {"near": ("0.6,0.74,0.6", "0.656,0.825,0.694"), "middle": ("0.62,0.76,0.62", "0.80,1.02,0.92"),
             "far": ("0.5,0.6,0.5", "1.25,1.8,2.1")}
looks = {"cotton print": "weave=plain thread_spacing=0.0004 gloss=0.15 texture=tartan texture_repeat=3",
         "denim": "weave=denim thread_spacing=0.0004 gloss=0.15 color=[0.045,0.105,0.25] back_color=[0.68,0.66,0.61]",
         "satin": "weave=satin thread_spacing=0.00025 gloss=0.85 color=[0.56,0.05,0.13] back_color=[0.62,0.14,0.20]",
         "wool": "weave=twill thread_spacing=0.0009 gloss=0 color=[0.47,0.33,0.22] back_color=[0.47,0.33,0.22]",
         "jersey": "weave=jersey thread_spacing=0.0009 gloss=0.1 color=[0.46,0.51,0.58] back_color=[0.46,0.51,0.58]"}
older_weaves = {"weave=jersey": "weave=twill"}  # what the older commit has in its place


def fail(message):
    sys.exit(f"tools/validate drawing: {message}")


def execute(words, cwd=root):
    done = subprocess.run([str(word) for word in words], cwd=cwd, capture_output=True, text=True)
    if done.returncode:
        fail(f"{' '.join(map(str, words))}:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout.strip()


def older_tree():
    name = execute(["git", "rev-parse", "--short", "--verify", f"{before}^{{commit}}"])
    tree = root / "build/against" / name
    if not tree.exists():
        execute(["git", "worktree", "prune"])
        execute(["git", "worktree", "add", "--detach", tree, name])
    return name, tree


def built(tree, tool):
    """A program of this folder, made with the libraries of a tree."""
    execute([tree / "tools/build", "release", "-DCLOTHSIM_TESTS=OFF", "--", "clothsim"], tree)
    folder = tree / "build/release"
    own = [folder / f"lib{name}.a" for name in ("clothsim_app", "cloth_gpu", "clothsim_core", "cloth_core", "clothsim_stb", "glad_gl45")]
    own = [library for library in own if library.exists()]
    program = folder / tool
    execute(["g++", "-std=c++20", "-O2", f"-I{tree}/src", f"-I{tree}/shaders", "-isystem", folder / "glad/include",
             root / "tools/drawing" / f"{tool}.cpp", "-o", program, "-Wl,--start-group", *own, "-Wl,--end-group", *libraries])
    return program


def write(name, columns, rows):
    with open(root / "report/data" / name, "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(columns)
        out.writerows(rows)


def device():
    for line in execute([root / "build/release/clothsim", "doctor"]).splitlines():
        if line.startswith("OpenGL"):
            return line.removeprefix("OpenGL").strip()
    return ""


def cost(trees, today):
    """By turns, so that what else the machine does falls on all alike."""
    programs = {which: built(tree, "draw_cost") for which, (_, tree) in trees.items()}
    times = {}
    for _ in range(rounds):
        for name, size, after in scenes:
            for moves in ("rests", "orbits"):
                for which, quality in (("before", "normal"), ("now", "normal"), ("now", "draft")):
                    took = execute([programs[which], name, size, after, quality, moves, pictures], trees[which][1])
                    times.setdefault((name, size, moves, which, quality), []).append(float(took))
    rows, used = [], device()
    for (name, size, moves, which, quality), took in times.items():
        ms = statistics.median(took)
        ratio = ms / statistics.median(times[name, size, moves, "before", "normal"])
        rows.append([today, trees[which][0], used, which, name, size, moves, quality, len(took), f"{ms:.1f}", f"{ratio:.2f}"])
        print(", ".join(map(str, rows[-1][3:])), flush=True)
    write("drawing_cost.csv", "date commit device program scene points camera quality rounds processor_ms times_before".split(), rows)


def flicker(trees, today):
    programs = {which: built(tree, "flicker") for which, (_, tree) in trees.items()}
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        rest = pathlib.Path(folder) / "rest"
        execute([programs["now"], "settle", rest, scene, points, settling_frames])
        for distance, (target, eye) in distances.items():
            for look, keys in looks.items():
                for which, quality, count in (("before", "normal", frames), ("now", "normal", frames), ("now", "draft", frames),
                                              ("now", "final", 4)):
                    words = keys.split() if which == "now" else [older_weaves.get(word, word) for word in keys.split()]
                    result = execute([programs[which], rest, root / scene, points, quality, count, target, eye,
                                      *[f"render.{word}" for word in words]], trees[which][1]).split()
                    rows.append([today, trees[which][0], which, look, distance, quality, count, *result])
                    print(", ".join(map(str, rows[-1][2:])), flush=True)
    write("flicker.csv", "date commit program look distance quality frames points mean_step share_above_16".split(), rows)


def run(commit, checks, quick=False):
    global rounds, pictures, frames
    if quick:
        rounds, pictures, frames = 1, 7, 6
    if not shutil.which("g++"):
        fail("g++ is missing")
    name, tree = older_tree()
    trees = {"now": (commit, root), "before": (name, tree)}
    for check in checks:
        {"cost": cost, "flicker": flicker}[check](trees, datetime.date.today().isoformat())
