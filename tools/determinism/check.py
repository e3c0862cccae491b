"""One hash for each scene and integrator, whatever compiled it, however many threads and whichever vectors computed it, and on
two OpenGL drivers (tools/validate determinism)."""
import csv, datetime, json, os, pathlib, shutil, subprocess, sys, tempfile

from tree import program, root

gl_tests = root / "build/release/tests/gl_tests"
frames_on_cpu, frames_on_drivers = 8, 2
threads = [1, 2, 7]
vectors = ["plain", "avx2", "avx512"]  # of g++, of which this processor may lack some
builds = [(compiler, level) for compiler in ("g++", "clang++-14") for level in ("-O1", "-O3")]
# Mesa's software drivers, chosen by no stronger variable than this one: tests set it to ask for a third.
drivers = {name: {"LIBGL_ALWAYS_SOFTWARE": "1", "GALLIUM_DRIVER": name} for name in ("llvmpipe", "zink")}
columns = "date commit command compiled_by device threads vectors scene integrator particles frames steps state_hash same".split()
path = root / "report/data/determinism.csv"


def fail(message):
    sys.exit(f"tools/validate determinism: {message}")


def execute(words, **environment):
    return subprocess.run([str(word) for word in words], cwd=root, capture_output=True, text=True,
                          env={**os.environ, **environment})


def build(compiler, level):
    """The program hash_scene, as CMakeLists.txt has it for everything else but the level of optimisation."""
    if not shutil.which(compiler):
        fail(f"{compiler} is missing (Debian: apt-get install clang-14)")
    folder = root / f"build/determinism_{compiler}{level}"  # as deep as build/release: a compiler cache serves both
    configure = ["cmake", "-S", ".", "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_COMPILER={compiler}",
                 f"-DCMAKE_CXX_FLAGS_RELEASE={level} -DNDEBUG", "-DCLOTHSIM_PROGRAM=OFF", "-DCLOTHSIM_TESTS=OFF"]
    if shutil.which("ccache"):
        configure.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
    for command in configure, ["ninja", "-C", folder, "hash_scene"]:
        done = execute(command)
        if done.returncode:
            fail(f"{' '.join(map(str, command))}:\n{done.stdout[-4000:]}{done.stderr[-4000:]}")
    print(f"built: {folder.relative_to(root)}", flush=True)
    return folder / "hash_scene"


class Table:
    """A line for every run; the first hash of a scene and integrator is the one that all others are compared with."""

    def __init__(self, commit):
        self.common = {"date": datetime.date.today().isoformat(), "commit": commit}
        self.lines, self.first = [], {}

    def add(self, command, compiled_by, device, thread_count, scene, integrator, particles, frames, steps, state_hash, vector_set=""):
        expected = self.first.setdefault((scene, integrator, frames), state_hash)
        same = "yes" if state_hash == expected else "no"
        self.lines.append({**self.common, "command": command, "compiled_by": compiled_by, "device": device,
                           "threads": thread_count, "vectors": vector_set, "scene": scene, "integrator": integrator, "particles": particles,
                           "frames": frames, "steps": steps, "state_hash": state_hash, "same": same})
        if same == "no":
            print(f"{scene}, {integrator}, {compiled_by}, {device}, {thread_count} threads: {state_hash}, expected {expected}", flush=True)

    def write(self):
        part = path.with_suffix(".part")
        with open(part, "w", newline="") as file:
            out = csv.DictWriter(file, columns, lineterminator="\n")
            out.writeheader()
            out.writerows(self.lines)
        os.replace(part, path)


def variants_of(scene):
    """(integrator, settings): an explicit one, the scene's own where it has one, and the implicit one in two steps a frame."""
    whole = json.loads((root / f"assets/scenes/{scene}.json").read_text())
    own = whole.get("solver", {}).get("integrator")
    explicit = own if own in ("verlet", "euler") else "verlet"
    settings = [f"solver.integrator={explicit}"]
    if any("material" in cloth for cloth in whole.get("cloths", [whole.get("cloth")])):
        settings.append("solver.simulation_steps=auto")
    return [(explicit, settings), ("implicit", ["solver.integrator=implicit", "solver.simulation_steps=2"])]


def on_cpu(table, scenes, executable, compiled_by, count, vector_set=""):
    environment = {"CLOTHSIM_THREADS": str(count), **({"CLOTHSIM_VECTORS": vector_set} if vector_set else {})}
    for scene in scenes:
        for integrator, settings in variants_of(scene):
            words = [executable, frames_on_cpu, scene, *settings]
            command = " ".join([f"{name}={value}" for name, value in environment.items()] + [str(word) for word in words])
            done = execute(words, **environment)
            if "CLOTHSIM_VECTORS is" in done.stderr:
                return print(f"{vector_set}: not on this processor", flush=True)
            if done.returncode:
                fail(f"{command}:\n{done.stderr}")
            particles, steps, state_hash = done.stdout.split()
            table.add(command, compiled_by, "CPU", count, scene, integrator, particles, frames_on_cpu, steps, state_hash, vector_set)
    print(f"{compiled_by}, {count} threads{vector_set and ', ' + vector_set}: done", flush=True)


def compilers(table, scenes):
    for compiler, level in builds:
        executable = build(compiler, level).relative_to(root)
        for count in threads:
            on_cpu(table, scenes, executable, f"{compiler} {level}", count)
        for vector_set in vectors if (compiler, level) == ("g++", "-O3") else []:
            on_cpu(table, scenes, executable, f"{compiler} {level}", 2, vector_set)


def opengl(table, scenes):
    for scene in scenes:
        for integrator, settings in variants_of(scene):
            for name, environment in {"CPU": {}, **drivers}.items():
                words = ["run", "-f", scene, "--backend", "cpu" if name == "CPU" else "gpu", "--frames", frames_on_drivers, "--json"]
                words += [word for setting in settings for word in ("--set", setting)]
                command = "clothsim " + " ".join(map(str, words))
                done = execute([program, *words], **environment)
                if not done.stdout:
                    fail(f"{command} on {name}:\n{done.stderr}")
                result = json.loads(done.stdout)
                if not result["device"].startswith(name):
                    fail(f"{name} was asked for, the device is {result['device']} (Debian: apt-get install mesa-vulkan-drivers)")
                table.add(command, "g++ -O3", result["device"], "", scene, integrator, result["particles"], frames_on_drivers,
                          result["steps"], result["state_hash"])
    print("drivers: done", flush=True)


def zink_tests(table):
    """The whole gl layer on the second driver."""
    if not gl_tests.exists():
        fail(f"{gl_tests} is missing; run `tools/build release` first")
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        done = execute([gl_tests, f"--gtest_output=json:{report}"], **drivers["zink"])
        if not report.exists():
            fail(f"the gl tests ended without a report on zink:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
        result = json.loads(report.read_text())
    for suite in result["testsuites"]:
        for test in suite["testsuite"]:
            if test.get("failures"):
                print(f'fails on zink: {suite["name"]}.{test["name"]}:\n{test["failures"][0]["failure"]}', flush=True)
    count, failures = result["tests"], result["failures"]
    print(f"gl tests on zink: {count - failures} of {count} passed", flush=True)
    table.lines.append({**table.common, "command": "build/release/tests/gl_tests", "compiled_by": "g++ -O3", "device": "zink",
                        "same": f"{count - failures} of {count} tests passed"})
    return failures


def run(commit, wanted):
    table = Table(commit)
    scenes = sorted(scene.stem for scene in (root / "assets/scenes").glob("*.json"))
    failures = 0
    if "compilers" in wanted:
        compilers(table, scenes)
    if "drivers" in wanted:
        opengl(table, scenes)
    if "tests" in wanted:
        failures = zink_tests(table)
    hashes = [line for line in table.lines if line.get("state_hash")]
    different = sum(line["same"] == "no" for line in hashes)
    print(f"{len(hashes)} hashes of {len(table.first)} simulations, {different} differ")
    if {"compilers", "drivers", "tests"} <= set(wanted):
        table.write()
        print(f"{path.relative_to(root)}: {len(table.lines)} lines")
    sys.exit(1 if different or failures else 0)
