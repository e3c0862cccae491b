"""How much a picture of cloth at rest flickers while the camera goes slowly around it (tools/validate flicker)."""
import concurrent.futures, csv, datetime, json, math, os, pathlib, shutil, subprocess, sys, tempfile

try:
    import numpy
except ImportError:
    sys.exit("tools/validate flicker: NumPy is missing (Debian: apt-get install python3-numpy, then /usr/bin/python3 tools/validate flicker)")

root = pathlib.Path(__file__).resolve().parent.parent.parent
path = root / "report/data/flicker.csv"
width, height, field_of_view = 640, 360, 30
degrees_a_frame = 0.2
points, settling_frames = "65x65", 60
columns = "date commit program look distance quality frames pixels mean_step share_of_large_steps".split()
LARGE = 16  # of 255
BORDER = 3  # [pixels] from where the cloth ends or hides itself

# What is set beside the scene, which is a sheet on a ball.
looks = {"cotton print": ["cloth.material=cotton", "render.texture=tartan", "render.texture_repeat=3"],
         "denim": ["cloth.material=denim"], "satin": ["cloth.material=silk"], "wool": ["cloth.material=wool"],
         "jersey": ["cloth.material=jersey"]}
# Target, and how far the camera is from it [m].
distances = {"near": ((0.62, 0.76, 0.62), 0.45), "far": ((0.5, 0.6, 0.5), 3.2)}


def fail(message):
    sys.exit(f"tools/validate flicker: {message}")


def execute(words, cwd=root):
    done = subprocess.run([str(word) for word in words], cwd=cwd, capture_output=True)
    if done.returncode:
        fail(f"{' '.join(map(str, words))}:\n{done.stderr.decode()[-2000:]}")
    return done.stdout


def settled(program, folder):
    """The state at rest and its triangles."""
    state, mesh = folder / "rest.state", folder / "rest.obj"
    execute([program, "run", "-f", "report/data/ball.json", "--resolution", points, "--backend", "cpu", "--frames", settling_frames,
             "--save", state, "--save", mesh])
    lines = [line.split() for line in mesh.read_text().splitlines()]
    places = numpy.array([[float(x) for x in words[1:4]] for words in lines if words[:1] == ["v"]])
    triangles = numpy.array([[int(word.split("/")[0]) - 1 for word in words[1:4]] for words in lines if words[:1] == ["f"]])
    return state, places, triangles


def eye_at(distance, frame):
    target, away = distances[distance]
    azimuth, elevation = math.radians(25 + degrees_a_frame * frame), math.radians(35)
    return [target[0] + away * math.cos(elevation) * math.sin(azimuth), target[1] + away * math.sin(elevation),
            target[2] + away * math.cos(elevation) * math.cos(azimuth)]


def seen(places, distance, frame):
    """Pixels, from the top left, and distances from the eye's plane."""
    eye, target = numpy.array(eye_at(distance, frame)), numpy.array(distances[distance][0])
    ahead = (target - eye) / numpy.linalg.norm(target - eye)
    right = numpy.cross(ahead, [0, 1, 0])
    right /= numpy.linalg.norm(right)
    up = numpy.cross(right, ahead)
    off = places - eye
    depth = off @ ahead
    scale = 0.5 * height / math.tan(math.radians(field_of_view) / 2)
    return numpy.stack([0.5 * width + scale * (off @ right) / depth, 0.5 * height - scale * (off @ up) / depth], -1), depth


def surface_at_pixels(places, triangles, distance, frame):
    """Points of the triangles under the middles of pixels, those alone that are BORDER pixels inside of what is seen as one."""
    pixels, depth = seen(places, distance, frame)
    nearest = numpy.full((height, width), numpy.inf)
    points = numpy.zeros((height, width, 3))
    for triangle in triangles:
        a, b, c = pixels[triangle]
        low = numpy.maximum(numpy.floor(numpy.minimum(numpy.minimum(a, b), c) - 0.5).astype(int), 0)
        high = numpy.minimum(numpy.ceil(numpy.maximum(numpy.maximum(a, b), c) - 0.5).astype(int) + 1, [width, height])
        if (low >= high).any():
            continue
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if abs(area) < 1e-12:
            continue
        x, y = numpy.meshgrid(numpy.arange(low[0], high[0]) + 0.5, numpy.arange(low[1], high[1]) + 0.5)
        wb = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
        wc = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
        shares = numpy.stack([1 - wb - wc, wb, wc], -1) / depth[triangle]  # as perspective has it
        away = 1 / shares.sum(-1)
        part = nearest[low[1]:high[1], low[0]:high[0]]
        wins = (wb >= 0) & (wc >= 0) & (wb + wc <= 1) & (away < part)
        part[wins] = away[wins]
        points[low[1]:high[1], low[0]:high[0]][wins] = ((shares * away[..., None]) @ places[triangle])[wins]
    inside = numpy.isfinite(nearest)
    steep = 0.02 * distances[distance][1]  # [m], between neighbouring pixels
    flat = numpy.where(inside, nearest, 1e9)
    for dy in range(-BORDER, BORDER + 1):
        for dx in range(-BORDER, BORDER + 1):
            inside &= numpy.abs(numpy.roll(flat, (dy, dx), (0, 1)) - flat) < steep * max(abs(dx), abs(dy), 1)
    inside[:BORDER], inside[-BORDER:], inside[:, :BORDER], inside[:, -BORDER:] = False, False, False, False
    return points[inside]


def drawn(program, state, look, distance, frame, quality, file):
    words = [program, "render", "-f", "report/data/ball.json", "--resolution", points, "--backend", "cpu", "--frames", 0, "--from", state,
             "--size", f"{width}x{height}", "--out", file, "--set", f"camera.position={json.dumps(eye_at(distance, frame))}",
             "--set", f"camera.target={json.dumps(distances[distance][0])}", "--set", f"camera.fov={field_of_view}"]
    for key in looks[look]:
        words += ["--set", key]
    execute(words + (["--quality", quality] if quality else []), program.parent.parent.parent)
    picture = numpy.frombuffer(execute(["convert", file, "-depth", "8", "rgb:-"]), numpy.uint8)
    return picture.reshape(height, width, 3).astype(float)


def sampled(picture, places):
    """Between the middles of pixels."""
    x, y = numpy.clip(places[:, 0] - 0.5, 0, width - 1.001), numpy.clip(places[:, 1] - 0.5, 0, height - 1.001)
    column, row = x.astype(int), y.astype(int)
    u, v = (x - column)[:, None], (y - row)[:, None]
    return ((1 - v) * ((1 - u) * picture[row, column] + u * picture[row, column + 1]) +
            v * ((1 - u) * picture[row + 1, column] + u * picture[row + 1, column + 1]))


def run(commit, options):
    if not shutil.which("convert"):
        fail("ImageMagick's convert is missing (Debian: apt-get install imagemagick)")
    programs = {"now": (root / "build/release/clothsim", ["draft", "normal"] if not options.qualities else options.qualities)}
    commits = {"now": commit}
    if options.before:
        programs["before"] = (options.before.resolve(), [None])
        commits["before"] = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=options.before.resolve().parent, capture_output=True,
                                           text=True).stdout.strip()
    rows = []
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        folder = pathlib.Path(name)
        state, places, triangles = settled(programs["now"][0], folder)
        for distance in options.distances or distances:
            # As the camera between two frames sees the cloth, so that both pictures are read between their pixels alike.
            between = list(pool.map(lambda k: surface_at_pixels(places, triangles, distance, k + 0.5), range(options.frames - 1)))
            for look in options.looks or looks:
                for which, (program, qualities) in programs.items():
                    for quality in qualities:
                        pictures = list(pool.map(lambda k: drawn(program, state, look, distance, k, quality, folder / f"{k}.png"),
                                                 range(options.frames)))
                        steps = [numpy.abs(sampled(pictures[k], seen(points, distance, k)[0]) -
                                           sampled(pictures[k + 1], seen(points, distance, k + 1)[0])).mean(-1)
                                 for k, points in enumerate(between)]
                        steps = numpy.concatenate(steps)
                        rows.append([datetime.date.today().isoformat(), commits[which], which, look, distance, quality or "", options.frames,
                                     len(steps) // (options.frames - 1), f"{steps.mean():.3f}", f"{(steps > LARGE).mean():.5f}"])
                        print(", ".join(map(str, rows[-1][2:])), flush=True)
    if options.out:
        new = {tuple(row[2:6]) for row in rows}
        kept = []
        if options.out.exists():
            with open(options.out, newline="") as file:
                kept = [line for line in csv.reader(file)][1:]
        with open(options.out, "w", newline="") as file:
            out = csv.writer(file, lineterminator="\n")
            out.writerow(columns)
            out.writerows([row for row in kept if tuple(row[2:6]) not in new] + rows)
