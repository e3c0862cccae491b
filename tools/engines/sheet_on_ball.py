"""A sheet falls on a ball, by clothsim, MuJoCo's flex and Newton's VBD (tools/validate engines): the same points, the same elastic
sheet, the same ball and friction. How far threads are stretched, how deep cloth is in the ball and what it costs, measured by
the same code from the places of the particles at each 1/60 s."""
import csv, datetime, json, os, pathlib, platform, resource, subprocess, sys, tempfile, time

from tree import program, root

path = root / "report/data/engines.csv"
columns = ("date commit command device program version points steps_in_a_60th settings self_contact seconds peak_strain_percent "
           "final_strain_percent deepest_mm lowest_m cpu_seconds unsolved_steps").split()

side, height, radius, middle, gravity, friction = 1.0, 1.0, 0.2, 0.6, 9.81, 0.4  # m, m/s^2; the ball's middle is at its height
density, stretch, poisson, thickness = 0.15, 1e4, 1 / 3, 5e-4  # kg/m^2, N/m; a lattice of springs has this Poisson's ratio
shear = stretch / (2 * (1 + poisson))
bending = stretch * thickness**2 / (12 * (1 - poisson**2))  # of a solid sheet of this thickness


class Watch:
    """What is measured, from places with y up and the ball above the origin."""

    def __init__(self, count):
        self.count, self.peak, self.final, self.deepest, self.lowest = count, 0.0, 0.0, 0.0, 0.0

    def look(self, places):
        import numpy
        grid = numpy.asarray(places, float).reshape(self.count, self.count, 3)
        spacing = side / (self.count - 1)
        threads = [numpy.linalg.norm(numpy.diff(grid, axis=axis), axis=2) for axis in (0, 1)]
        self.final = max(float(numpy.abs(length / spacing - 1).max()) for length in threads)
        self.peak = max(self.peak, self.final)
        self.deepest = max(self.deepest, radius - float(numpy.linalg.norm(grid - [0, middle, 0], axis=2).min()))
        self.lowest = float(grid[..., 1].min())


def device():
    found = [line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
    return f"{found[0]}, {len(found)} cores" if found else platform.machine()


def write_sheet(file, count):
    """As a mesh: both others make two triangles of each cell, too."""
    at = lambda row, column: row * count + column + 1
    with open(file, "w") as out:
        for k in range(count * count):
            out.write(f"v {side * (k % count / (count - 1) - .5):.9g} {height} {side * (k // count / (count - 1) - .5):.9g}\n")
        for row in range(count - 1):
            for column in range(count - 1):
                a, b, c, d = at(row, column), at(row, column + 1), at(row + 1, column), at(row + 1, column + 1)
                out.write(f"f {a} {c} {d}\nf {a} {d} {b}\n")


def clothsim(count, steps, touches, frames, kind="mesh"):
    shape = {"mesh": "sheet.obj"} if kind == "mesh" else {
        "width": side, "height": side, "num_width_points": count, "num_height_points": count, "orientation": "horizontal",
        "position": [-side / 2, height - 1, -side / 2]}
    scene = {"gravity": [0, -gravity, 0],
             "cloth": {**shape, "material": {"density": density, "stretch": stretch, "shear": shear, "bend": bending, "damping": 0,
                                             "thickness": thickness}},
             "sphere": {"origin": [0, middle, 0], "radius": radius, "friction": friction},
             "solver": {"integrator": "implicit", "frames_per_sec": 60, "simulation_steps": steps or "auto",
                        "self_collision": "contact" if touches else False}}
    with tempfile.TemporaryDirectory() as folder:
        file, cache = pathlib.Path(folder) / "sheet.json", pathlib.Path(folder) / "all.pc2"
        file.write_text(json.dumps(scene))
        write_sheet(file.with_name("sheet.obj"), count)
        words = [program, "run", "-f", file, "--backend", "cpu", "--threads", "1", "--frames", str(frames), "--json"]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = subprocess.run(words, capture_output=True, text=True, cwd=root)
        cost = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        if done.returncode:
            sys.exit(f"tools/validate engines: {done.stderr}")
        result = json.loads(done.stdout)
        subprocess.run([*words, "--save", cache], capture_output=True, cwd=root, check=True)
        sys.path.insert(0, str(root / "tools/contact"))
        import judges
        places = judges.read_cache(cache)
    watch = Watch(count)
    for place in places:
        watch.look(place)
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.split()[1]
    return watch, cost, version, result["simulation_steps"], f"implicit, a {kind}", result["convergence"]["unconverged_steps"]


def clothsim_grid(*arguments):
    return clothsim(*arguments, kind="grid")


def mujoco(count, steps, touches, frames):
    import mujoco as engine
    spacing = side / (count - 1)
    model = engine.MjModel.from_xml_string(f'''<mujoco><size memory="4G"/>
      <option timestep="{1 / 60 / steps}" integrator="discrete" gravity="0 {-gravity} 0" solver="CG" iterations="100" tolerance="1e-6"/>
      <worldbody><geom type="sphere" size="{radius}" pos="0 {middle} 0" friction="{friction}"/>
      <flexcomp name="sheet" type="grid" dim="2" count="{count} {count} 1" spacing="{spacing} {spacing} {spacing}" pos="0 {height} 0"
        euler="90 0 0" mass="{density * side * side}" radius="{thickness / 2}">
        <contact selfcollide="{"auto" if touches else "none"}" friction="{friction} .005 .0001" condim="3"/>
        <elasticity young="{stretch / thickness}" poisson="{poisson}" thickness="{thickness}" elastic2d="both"/>
      </flexcomp></worldbody></mujoco>''')
    data, watch = engine.MjData(model), Watch(count)
    begun = time.process_time()
    for _ in range(frames):
        for _ in range(steps):
            engine.mj_step(model, data)
        engine.mj_kinematics(model, data)
        engine.mj_flex(model, data)
        watch.look(data.flexvert_xpos)
    return watch, time.process_time() - begun, engine.__version__, steps, "flex, elastic2d both, integrator discrete, solver CG", ""


def newton(count, steps, touches, frames, iterations=20):
    import warp
    warp.config.quiet = True
    import newton as engine
    spacing = side / (count - 1)
    builder = engine.ModelBuilder(up_axis=engine.Axis.Y)
    builder.add_shape_sphere(-1, xform=warp.transform(warp.vec3(0, middle, 0), warp.quat_identity()), radius=radius)
    builder.add_cloth_grid(pos=warp.vec3(-side / 2, height, side / 2), rot=warp.quat_from_axis_angle(warp.vec3(1, 0, 0), -3.14159265 / 2),
                           vel=warp.vec3(0, 0, 0), dim_x=count - 1, dim_y=count - 1, cell_x=spacing, cell_y=spacing,
                           mass=density * side * side / count**2, tri_ke=shear, tri_ka=stretch * poisson / (1 - poisson**2), tri_kd=0.0,
                           edge_ke=bending, edge_kd=0.0, particle_radius=thickness / 2)
    builder.color(include_bending=True)
    model = builder.finalize(device="cpu")
    model.soft_contact_ke, model.soft_contact_kd, model.soft_contact_mu = 1e4, 0.0, friction
    solver = engine.solvers.SolverVBD(model=model, iterations=iterations, particle_enable_self_contact=touches,
                                      particle_self_contact_margin=thickness, particle_self_contact_gap=thickness)
    pipeline = engine.CollisionPipeline(model, soft_contact_gap=0.01)
    contacts, control = pipeline.contacts(), model.control()
    now, after, watch = model.state(), model.state(), Watch(count)

    def step(seconds):
        nonlocal now, after
        now.clear_forces()
        pipeline.collide(now, contacts)
        solver.step(now, after, control, contacts, seconds)
        now, after = after, now

    step(1e-9)  # compiles the kernels, which is not counted
    begun = time.process_time()
    for _ in range(frames):
        for _ in range(steps):
            step(1 / 60 / steps)
        watch.look(now.particle_q.numpy())
    return watch, time.process_time() - begun, engine.__version__, steps, f"VBD, {iterations} iterations a step", ""


# Steps in 1/60 s, and whether layers touch. clothsim chooses the first itself; the others take what they need to end about as stiff.
runs = [(clothsim, 0, False), (clothsim, 0, True), (clothsim_grid, 0, True), (mujoco, 4, False), (mujoco, 8, False), (newton, 10, False)]


def run(commit, options):
    try:
        import mujoco as _, newton as _, numpy as _  # noqa: F401
    except ImportError as missing:
        sys.exit(f"tools/validate: {missing.name} is missing; `pip install mujoco newton numpy` in a virtual environment, and run this "
                 "with its python3")
    lines = []
    for count in options.sizes:
        for engine, steps, touches in runs:
            if engine.__name__ not in options.engines:
                continue
            watch, cost, version, steps, settings, unsolved = engine(count, steps, touches, options.frames)
            values = [datetime.date.today().isoformat(), commit, "tools/validate engines", device(),
                      engine.__name__, version, f"{count}x{count}", steps, settings, "on" if touches else "off", f"{options.frames / 60:.3g}",
                      f"{100 * watch.peak:.3g}", f"{100 * watch.final:.3g}", f"{1e3 * watch.deepest:.3g}", f"{watch.lowest:.3f}", f"{cost:.1f}", unsolved]
            lines.append(dict(zip(columns, values, strict=True)))
            print("  ".join(str(value) for value in values[4:]), flush=True)
            part = path.with_suffix(".part")
            with open(part, "w", newline="") as file:
                out = csv.DictWriter(file, columns, lineterminator="\n")
                out.writeheader()
                out.writerows(lines)
            os.replace(part, path)
