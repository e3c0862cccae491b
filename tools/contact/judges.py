"""Contact inside the step, judged by others (tools/validate contact): every step of 13 scenes is exported and looked at by
ipctk, and by formulas of this folder where it is about colliders. What the program says of itself stands beside it."""
import concurrent.futures, csv, datetime, json, os, pathlib, shlex, subprocess, sys, tempfile

from tree import program, root


# Frames of 1/60 s: until the cloth lies, or what is pulled and folded has been.
scenes = {"sphere": 90, "selfCollision": 100, "fold": 225, "twist": 225, "stack": 75, "funnel": 180, "drape_box": 100, "bed": 60,
          "coat_hook": 75, "pebbles": 60, "wring": 225, "demo": 120, "pillow": 60}
fabrics = ["cotton", "silk"]
columns = ("date commit scene points fabric steps_a_frame seed frames ipctk_crossed_steps ipctk_blocked_steps cgal_crossings "
           "contact_sound deepest_vertex_mm deepest_side_mm peak_strain least_gap_mm unsolved_steps steps guarded_steps "
           "pin_lag_mm ipctk judged_in_s simulated_in_s run").split()


def points(scene, size):
    """The strips of twist and wring are four and six times as long as wide; fold has a column in the middle."""
    longer = {"twist": 2 * size - 1, "wring": 3 * size - 2}
    return f"{longer[scene]}x{(size + 1) // 2}" if scene in longer else f"{size}x{size}"


def command_of(scene, size, fabric, steps, seed):
    """A frame is a step, so that each is exported: `steps` of them in 1/60 s."""
    text = json.loads((root / f"assets/scenes/{scene}.json").read_text())
    cloths = len(text.get("cloths", [None]))
    settings = {**{f"cloths.{i}.material": fabric for i in range(cloths)}, "solver.integrator": "implicit",
                "solver.self_collision": "contact", "solver.strain_limit": "false", "solver.simulation_steps": 1,
                "solver.frames_per_sec": 60 * steps}
    return ["run", "-f", scene, "--backend", "cpu", "--threads", "1", "--resolution", points(scene, size), "--frames",
            str(scenes[scene] * steps), "--jitter", "1e-4", "--seed", str(seed),
            *(word for key, value in settings.items() for word in ("--set", f"{key}={value}"))], text.get("colliders", [])


def read_cache(path):
    import numpy
    data = path.read_bytes()
    count, samples = (int(numpy.frombuffer(data, "<i4", 1, at)[0]) for at in (16, 28))
    return numpy.frombuffer(data, "<f4", 3 * count * samples, 32).reshape(samples, count, 3).astype(float)


def read_triangles(path):
    import numpy
    corners = [[int(word.split("/")[0]) - 1 for word in line.split()[1:]] for line in path.read_text().splitlines() if line.startswith("f ")]
    return numpy.array([[face[0], face[i], face[i + 1]] for face in corners for i in range(1, len(face) - 1)], dtype=numpy.int32)


def joints_of(scene, size, particles):
    """Of each particle the lowest one that the scene's seams join to it. Seams from side to side of square grids, as in pillow."""
    import numpy
    text = json.loads((root / f"assets/scenes/{scene}.json").read_text())
    joints = numpy.arange(particles)
    grid = numpy.arange(size * size).reshape(size, size)
    sides = {"bottom": grid[0], "top": grid[-1], "left": grid[:, 0], "right": grid[:, -1]}
    for seam in text.get("seams", []):
        a, b = (sides[seam[end]["points"][0]][::-1 if seam[end].get("reverse") else 1] + seam[end]["cloth"] * size * size for end in "ab")
        for i, j in zip(a, b, strict=True):
            joints[joints == max(joints[i], joints[j])] = min(joints[i], joints[j])
    return joints


class Judge:
    """ipctk on one mesh. Parts that share a sewn point are left out, as parts that share a corner are: seams close."""

    def __init__(self, places, triangles, joints):
        import ipctk, numpy
        self.mesh = ipctk.CollisionMesh(places, ipctk.edges(triangles), triangles)
        sewn = numpy.bincount(joints, minlength=len(joints))[joints] > 1
        self.joints = numpy.where(sewn, joints, -1 - numpy.arange(len(joints))) if sewn.any() else None
        # By default ipctk also refuses a way that leaves less than a fifth of the distance at its start; here less
        # than a ten thousandth.
        self.ccd = ipctk.TightInclusionCCD(conservative_rescaling=0.9999)

    def _are_sewn(self, a, b):
        return not set(self.joints[a]).isdisjoint(self.joints[b])

    def crosses(self, places):
        import ipctk
        if self.joints is None:
            return ipctk.has_intersections(self.mesh, places)
        phase = ipctk.LBVH()
        phase.build(places, self.mesh.edges, self.mesh.faces)
        for pair in phase.detect_edge_face_candidates():
            edge, face = self.mesh.edges[pair.edge_id], self.mesh.faces[pair.face_id]
            if not self._are_sewn(edge, face) and ipctk.is_edge_intersecting_triangle(*places[edge], *places[face]):
                return True
        return False

    def goes_free(self, before, after):
        """Whether nothing meets on the straight way from one frame to the next."""
        import ipctk
        if self.joints is None:
            return ipctk.is_step_collision_free(self.mesh, before, after, narrow_phase_ccd=self.ccd)
        ways = ipctk.Candidates()
        ways.build(self.mesh, before, after)
        edges, faces = self.mesh.edges, self.mesh.faces
        pairs = [(edges[way.edge0_id], edges[way.edge1_id], way) for way in ways.ee_candidates]
        pairs += [(faces[way.face_id], [way.vertex_id], way) for way in ways.fv_candidates]
        for a, b, way in pairs:
            if self._are_sewn(a, b):
                continue
            corners = [corner for corner in way.vertex_ids(edges, faces) if corner >= 0]
            if way.ccd(before[corners].ravel(), after[corners].ravel(), narrow_phase_ccd=self.ccd)[0]:
                return False
        return True


def check_the_judge():
    """A judge that finds nothing is worth something only when it finds what is there."""
    import ipctk, numpy
    triangle = numpy.array([[0, 0, 0], [1, 0, 0], [0, 0, 1.0]])
    faces = numpy.array([[0, 1, 2], [3, 4, 5]], dtype=numpy.int32)
    places = {height: numpy.asfortranarray(numpy.vstack([triangle, triangle[:, [0, 2, 1]] * [1, .4, 1] + [.2, height, .2]]))
              for height in (.1, -.1, -.5)}
    # Without seams; with a seam elsewhere, so that pairs are looked at one by one; and where all that meets is sewn.
    for extra, joints in ((0, range(6)), (2, (*range(6), 6, 6)), (0, (0, 1, 2, 1, 4, 2))):
        high, low, lower = (numpy.asfortranarray(numpy.vstack([places[height], numpy.full((extra, 3), 9.)])) for height in (.1, -.1, -.5))
        found = Judge(high, faces, numpy.array(joints))
        sewn = joints[3] == 1
        assert found.crosses(low) == (not sewn) and not found.crosses(high)
        assert found.goes_free(high, lower) == sewn, "one triangle goes through the other"
        assert found.goes_free(high, high + [.3, 0, 0])


def judge(job):
    import ipctk, numpy, resource, time
    import shapes
    scene, size, fabric, steps, seed = job
    words, colliders = command_of(*job)
    with tempfile.TemporaryDirectory() as folder:
        cache = pathlib.Path(folder) / "all.pc2"
        done = subprocess.run([program, *words, "--save", cache, "--check-crossings", "--json"], capture_output=True, text=True, cwd=root)
        if not done.stdout.strip():
            return job, None, done.stderr.strip()[-300:]
        result = json.loads(done.stdout)
        frames, triangles = read_cache(cache), read_triangles(cache.with_name("all_rest.obj"))
    begun = time.process_time()
    ipctk.set_num_threads(1)
    seconds = scenes[scene] / 60
    crossed = blocked = 0
    vertex = side = 0.0
    found = Judge(numpy.asfortranarray(frames[0]), triangles, joints_of(scene, size, frames.shape[1]))
    edges = found.mesh.edges
    for at, place in enumerate(numpy.asfortranarray(frame) for frame in frames):
        crossed += found.crosses(place)
        blocked += at > 0 and not found.goes_free(before, place)
        if at > 0:  # where the jitter has put it at the start is not the solver's
            vertex = max(vertex, shapes.depth(place, colliders, seconds))
            side = max(side, shapes.depth(place[edges].mean(axis=1), colliders, seconds))
        before = place
    contact, ends = result["contact"], result["convergence"]
    gap = contact["least_gap"]
    values = [result["frames"], crossed, blocked, result["crossings"]["worst"], result["contact_sound"], f"{1e3 * vertex:.3g}", f"{1e3 * side:.3g}",
              f'{result["peak_strain"]:.4g}', "" if gap is None else f"{1e3 * gap:.3g}", ends["unconverged_steps"], ends["steps"],
              contact["guarded_steps"], f'{1e3 * contact["pin_lag"]:.3g}', ipctk.__version__, f"{time.process_time() - begun:.1f}",
              f'{result["seconds"]:.1f}', "clothsim " + " ".join(shlex.quote(word) for word in words)]
    return job, [scene, points(scene, size), fabric, steps, seed, *values], None


def key(line):
    return tuple(str(line[name]) for name in ("scene", "points", "fabric", "steps_a_frame", "seed"))


def run(commit, options):
    try:
        import ipctk, numpy  # noqa: F401
    except ImportError as missing:
        sys.exit(f"tools/validate: {missing.name} is missing; `pip install ipctk numpy` in a virtual environment, and run this with its python3")
    check_the_judge()
    path = root / "report/data/contact_judges.csv"
    jobs = [(scene, size, fabric, steps, seed) for size in options.sizes for seed in range(1, options.jitters + 1) for steps in (1, 2)
            for fabric in fabrics for scene in options.scenes or scenes]
    kept = {}
    if path.exists():
        with open(path, newline="") as file:
            kept = {key(line): line for line in csv.DictReader(file)}
    head = [datetime.date.today().isoformat(), commit]
    failed = False
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        for done in concurrent.futures.as_completed([pool.submit(judge, job) for job in jobs]):
            if done.exception():
                print(f"failed: {done.exception()}", flush=True)
                failed = True
                continue
            job, values, error = done.result()
            if error:
                print(f"{job}: failed: {error}", flush=True)
                failed = True
                continue
            line = dict(zip(columns, head + values, strict=True))
            kept[key(line)] = line
            failed |= bool(line["ipctk_crossed_steps"] or line["cgal_crossings"] or not line["contact_sound"])
            print("  ".join(str(value) for value in values[:18]), flush=True)
            part = path.with_suffix(".part")  # after every run: a table of hours survives an end in the middle
            with open(part, "w", newline="") as file:
                out = csv.DictWriter(file, columns, lineterminator="\n")
                out.writeheader()
                out.writerows(line for _, line in sorted(kept.items()))
            os.replace(part, path)
    return failed
