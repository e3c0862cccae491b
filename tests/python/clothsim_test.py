"""The Python package against the program and against formulas. CLOTHSIM_PROGRAM names the program."""

import ast
import contextlib
import csv
import gc
import io
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import clothsim
from needs_opengl import NeedsOpenGl
import numpy as np

PROGRAM = os.environ["CLOTHSIM_PROGRAM"]
FREE_PARTICLE = {  # a tiny sheet without springs' influence: it falls freely
    "gravity": [0, -9.8, 0],
    "cloth": {"width": 1, "height": 1, "num_width_points": 4, "num_height_points": 4, "ks": 0.001, "damping": 0},
    "solver": {"integrator": "euler", "simulation_steps": 10, "self_collision": False},
}


def program(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)


def run_json(*arguments):
    return json.loads(program("run", "--backend", "cpu", "--json", *arguments).stdout)


class AgainstTheProgram(unittest.TestCase):
    def test_state_hashes_of_bundled_scenes_are_the_programs(self):
        names = clothsim.scenes()
        self.assertIn("pinned2", names)
        slow = {"walk", "cape"}  # whose bodies take two seconds to load; skirt has a smaller one
        for name in sorted(set(names) - slow):
            with self.subTest(scene=name):
                sim = clothsim.Simulation(name, backend="cpu")
                sim.step_frames(1)
                self.assertEqual(sim.state_hash, run_json("-f", name, "--frames", "1")["state_hash"])

    def test_settings_resolution_and_jitter_are_those_of_the_command_line(self):
        sim = clothsim.Simulation(
            "pinned2",
            backend="cpu",
            resolution=(20, 30),
            jitter=0.001,
            seed=7,
            **{"cloth.ks": 500, "wind.velocity": np.array([0, 0, 4]), "solver.integrator": "euler"},
        )
        sim.step_frames(2)
        told = run_json("-f", "pinned2", "--resolution", "20x30", "--jitter", "0.001", "--seed", "7", "--set",
                        "cloth.ks=500", "--set", "wind.velocity=[0,0,4]", "--set", "solver.integrator=euler",
                        "--frames", "2")
        self.assertEqual(sim.state_hash, told["state_hash"])
        self.assertEqual(len(sim.positions), told["particles"])
        self.assertEqual(len(sim.faces), told["triangles"])

    def test_measures_have_the_names_and_values_of_run_json(self):
        told = run_json("-f", "selfCollision", "--frames", "5")
        sim = clothsim.Simulation("selfCollision", backend="cpu")
        for _ in range(5):
            sim.step_frames()
            measured = sim.measures()
        self.assertGreater(len(measured), 10)
        for name, value in measured.items():
            self.assertEqual(value, told[name], name)

    def test_run_returns_the_columns_of_the_programs_trace(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "energies.csv")
            program("run", "-f", "cs171", "--backend", "cpu", "--frames", "4", "--trace", path, "--set",
                    "solver.integrator=implicit", "--set", "solver.simulation_steps=1")
            with open(path, newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
        trace = clothsim.Simulation(
            "cs171", backend="cpu", **{"solver.integrator": "implicit", "solver.simulation_steps": 1}
        ).run(4)
        self.assertEqual(list(rows[0]), list(trace))
        self.assertEqual(len(rows), 5)
        for name, values in trace.items():
            self.assertEqual([float(row[name]) for row in rows], list(values), name)
        self.assertEqual(list(trace["implicit_steps"]), [0, 1, 1, 1, 1])
        self.assertTrue((trace["cg_iterations"][1:] > 0).all())

    def test_energies_and_momenta_of_a_fall_are_those_of_the_formulas(self):
        sim = clothsim.Simulation(FREE_PARTICLE, backend="cpu")
        mass = float((1 / sim.inverse_masses).sum())
        trace = sim.run(9)
        speed = 9.8 * trace["time"]
        np.testing.assert_allclose(trace["momentum_y"], -mass * speed, rtol=1e-5, atol=1e-9)
        np.testing.assert_allclose(trace["kinetic_energy"], 0.5 * mass * speed**2, rtol=1e-5, atol=1e-9)
        fallen = trace["centroid_y"][0] - trace["centroid_y"]
        np.testing.assert_allclose(trace["gravity_energy"], -mass * 9.8 * fallen, rtol=1e-5, atol=1e-6)
        np.testing.assert_allclose(
            trace["total_energy"], trace["kinetic_energy"] + trace["gravity_energy"] + trace["spring_energy"]
        )

    def test_errors_are_those_of_the_program(self):
        said = program("run", "-f", "pinned2", "--backend", "cpu", "--frames", "0", "--set", "cloth.kss=1").stderr
        with self.assertRaises(clothsim.SceneError) as caught:
            clothsim.Simulation("pinned2", backend="cpu", **{"cloth.kss": 1})
        self.assertIn(str(caught.exception), said)
        self.assertIsInstance(caught.exception, ValueError)
        with self.assertRaisesRegex(clothsim.UsageError, "expected auto, cpu or gpu"):
            clothsim.Simulation("pinned2", backend="cuda")
        with self.assertRaises(clothsim.InputOutputError) as caught:
            clothsim.Simulation("pinned2", backend="cpu").load("/nonexistent.state")
        self.assertIsInstance(caught.exception, OSError)

    def test_states_go_to_the_program_and_back(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "half.state")
            sim = clothsim.Simulation("pinned2", backend="cpu")
            sim.step_frames(2)
            sim.save(path)
            told = run_json("-f", "pinned2", "--from", str(path), "--frames", "2")
            kept = sim.get_state()
            sim.step_frames(2)
            self.assertEqual(sim.state_hash, told["state_hash"])
            other = clothsim.Simulation("pinned2", backend="cpu")
            other.set_state(kept)
            other.step_frames(2)
            self.assertEqual(other.state_hash, told["state_hash"])
            other.load(path)
            self.assertAlmostEqual(other.time, 2 / 90)

    def test_remarks_are_what_the_program_tells_on_stderr(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "pinned.state")
            sim = clothsim.Simulation("pinned2", backend="cpu", resolution=(9, 9))
            pins = sim.pins
            pins[40] = True
            sim.pins = pins
            sim.save(path)
            other = clothsim.Simulation("pinned2", backend="cpu", resolution=(9, 9))
            of_the_scene = other.remarks
            other.load(path)
            said = program("run", "-f", "pinned2", "--backend", "cpu", "--resolution", "9x9", "--from", path,
                           "--frames", "0", "--json").stderr
            self.assertEqual(["clothsim: " + remark for remark in other.remarks], said.splitlines())
            self.assertIn("1 particle is pinned there", other.remarks[-1])
            other.reset()
            self.assertEqual(other.remarks, of_the_scene)

    def test_saved_arrays_are_those_of_the_simulation(self):
        with tempfile.TemporaryDirectory() as folder:
            path, trace = os.path.join(folder, "cloth.npz"), os.path.join(folder, "trace.npz")
            told = run_json("-f", "skirt", "--frames", "2", "--save", path, "--trace", trace)
            saved, traced = np.load(path), np.load(trace)
            with open(path, "rb") as file:
                first = file.read()
            sim = clothsim.Simulation("skirt", backend="cpu")
            columns = sim.run(2)
            self.assertEqual(sim.state_hash, told["state_hash"])
            for name in ("positions", "velocities", "inverse_masses", "faces"):
                np.testing.assert_array_equal(saved[name], getattr(sim, name), err_msg=name)
                self.assertEqual(saved[name].dtype, getattr(sim, name).dtype, name)
            self.assertEqual(saved["texture_coordinates"].shape, (len(sim.positions), 2))
            self.assertEqual(saved["step"].shape, ())
            self.assertEqual(int(saved["step"]), told["steps"])
            self.assertEqual(sorted(traced), sorted(columns))
            for name, values in columns.items():
                np.testing.assert_array_equal(traced[name], values, err_msg=name)
            sim.save(path)
            with open(path, "rb") as file:
                self.assertEqual(file.read(), first, "the same bytes each time")

    def test_faces_are_those_that_are_left_of_torn_cloth(self):
        sim = clothsim.Simulation("tear", resolution=(25, 25), backend="cpu")
        whole = len(sim.faces)
        sim.step_frames(45)
        self.assertLess(len(sim.faces), whole)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "torn.npz")
            sim.save(path)
            np.testing.assert_array_equal(np.load(path)["faces"], sim.faces)


class Arrays(unittest.TestCase):
    def test_positions_are_a_view_that_shows_the_current_state_at_one_address(self):
        for scene, settings in (("pinned2", {}), ("selfCollision", {}), ("pinned4", {"solver.integrator": "implicit"})):
            sim = clothsim.Simulation(scene, backend="cpu", **settings)
            positions, velocities, masses = sim.positions, sim.velocities, sim.inverse_masses
            before = positions.copy()
            for steps in (1, 2, 3, 1):
                sim.step(steps)
                self.assertEqual(positions.ctypes.data, sim.positions.ctypes.data)
                self.assertEqual(velocities.ctypes.data, sim.velocities.ctypes.data)
                self.assertEqual(masses.ctypes.data, sim.inverse_masses.ctypes.data)
            self.assertFalse(np.array_equal(before, positions))
            apart = clothsim.Simulation(scene, backend="cpu", **settings)  # nobody looks at its memory
            apart.step(7)
            self.assertEqual(sim.state_hash, apart.state_hash)
            np.testing.assert_array_equal(positions, apart.positions)
            np.testing.assert_array_equal(velocities, apart.velocities)

    def test_views_are_read_only_and_outlive_the_simulation(self):
        sim = clothsim.Simulation("pinned2", backend="cpu")
        positions, faces = sim.positions, sim.faces
        with self.assertRaises(ValueError):
            positions[0] = 1
        kept = positions.copy()
        sim.reset()
        sim.step()
        np.testing.assert_array_equal(positions, kept)  # of the state before the reset
        del sim
        gc.collect()
        np.testing.assert_array_equal(positions, kept)
        self.assertEqual(int(faces.max()), len(positions) - 1)

    def test_what_is_written_is_there_and_moves_on(self):
        sim = clothsim.Simulation(FREE_PARTICLE, backend="cpu")
        view = sim.positions
        start = np.array(view)
        sim.positions = start + [0, 1, 0]
        np.testing.assert_array_equal(view, (start + [0, 1, 0]).astype(np.float32))
        sim.velocities = np.tile([1.0, 2.0, 0.0], (len(start), 1))
        sim.step(10)
        # Symplectic Euler: y = y0 + v t - g h^2 n (n + 1) / 2
        h = sim.time / 10
        want = start + [1 * sim.time, 1 + 2 * sim.time - 9.8 * h * h * 55, 0]
        np.testing.assert_allclose(view, want, atol=2e-6)

    def test_wrong_arrays_are_refused_and_nothing_changes(self):
        sim = clothsim.Simulation("pinned2", backend="cpu")
        before = sim.state_hash
        with self.assertRaisesRegex(clothsim.UsageError, r"positions: expected an array of shape \(2500, 3\)"):
            sim.positions = np.zeros((3, 3))
        broken = np.array(sim.positions)
        broken[17, 1] = np.nan
        with self.assertRaisesRegex(clothsim.UsageError, "particle 17 is not finite"):
            sim.positions = broken
        with self.assertRaisesRegex(clothsim.UsageError, "pins: expected an array of 2500 booleans"):
            sim.pins = np.zeros(3, dtype=bool)
        with self.assertRaisesRegex(clothsim.UsageError, r"2500 booleans, found int64 of shape \(2500,\)"):
            sim.pins = np.zeros(2500, dtype=np.int64)
        with self.assertRaisesRegex(clothsim.UsageError, r"2500 booleans, found int64 of shape \(2,\)"):
            sim.pins = [0, 49]
        self.assertEqual(sim.state_hash, before)

    def test_pins_hold_and_free_particles_fall_again(self):
        sim = clothsim.Simulation("pinned2", backend="cpu")
        pins = sim.pins
        self.assertEqual(pins.sum(), 2)
        pins[:] = False
        pins[1234] = True
        sim.pins = pins
        held = np.array(sim.positions[1234])
        freed = int(np.flatnonzero(clothsim.Simulation("pinned2", backend="cpu").pins)[0])
        height = float(sim.positions[freed, 1])
        sim.step_frames(3)
        np.testing.assert_array_equal(sim.positions[1234], held)
        self.assertLess(sim.positions[freed, 1], height)
        self.assertEqual(sim.inverse_masses[1234], 0)
        self.assertGreater(sim.inverse_masses[freed], 0)


class Acting(unittest.TestCase):
    def test_reset_goes_back_to_the_start_and_seeds_repeat(self):
        sim = clothsim.Simulation("pinned2", backend="cpu", jitter=0.01, seed=3)
        start = sim.state_hash
        sim.set(**{"gravity": [0, 0, 1]})
        sim.step_frames(1)
        self.assertNotEqual(sim.state_hash, start)
        sim.reset(seed=4)
        self.assertNotEqual(sim.state_hash, start)
        sim.reset()
        self.assertEqual((sim.state_hash, sim.time), (start, 0))
        self.assertEqual(sim.scene, clothsim.Simulation("pinned2", backend="cpu").scene)

    def test_reading_changes_nothing(self):
        hashes = set()
        for reads in (False, True):
            sim = clothsim.Simulation("pinned2", backend="cpu", resolution=(6, 6))
            sim.step_frames(1)
            for setting in ({"solver.integrator": "euler"}, {"gravity": [3, 0, 0]}, {"solver.integrator": "verlet"}):
                sim.set(**setting)
                if reads:
                    self.assertEqual(len(sim.velocities), 36)
            sim.step_frames(1)
            hashes.add(sim.state_hash)
        self.assertEqual(len(hashes), 1)

    def test_forces_accelerate_and_balance_weight(self):
        for integrator in ("verlet", "euler", "implicit", "bdf2"):
            with self.subTest(integrator=integrator):
                sim = clothsim.Simulation(FREE_PARTICLE, backend="cpu", **{"solver.integrator": integrator})
                start, masses = np.array(sim.positions), 1 / sim.inverse_masses[:, None]
                self.assertFalse(sim.forces.any())
                sim.forces = masses * [3, 9.8, 0]  # carries the weight, and pushes sideways
                sim.step(10)
                moved = sim.positions - start
                # after n steps a h^2 n (n + 1) / 2, in steps of second order between that and a t^2 / 2
                h = sim.time / 10
                low, high = 3 * h * h * 50, 3 * h * h * 55
                self.assertGreater(moved[:, 0].min(), 0.999 * low)
                self.assertLess(moved[:, 0].max(), 1.001 * high)
                np.testing.assert_allclose(moved[:, 1:], 0, atol=3e-6)
                sim.forces = None
                speed = sim.velocities[:, 0].mean()
                sim.step(10)
                # bdf2 goes on with half of what the last step before changed: (4 v1 - v0) / 3 and so on
                rest = 3 * h / 2 if integrator == "bdf2" else 0
                self.assertAlmostEqual(sim.velocities[:, 0].mean(), speed + rest, places=4)
        with self.assertRaisesRegex(clothsim.UsageError, "forces: expected an array of shape"):
            sim.forces = np.zeros((2, 3))

    def test_a_collider_goes_straight_to_its_place_and_stays(self):
        sim = clothsim.Simulation("sphere", backend="cpu")
        start = np.array(sim.collider_positions[0])
        sim.move_collider(0, start + [0, 0.2, 0], seconds=4 * 1 / 90)
        sim.step_frames(2)
        np.testing.assert_allclose(sim.collider_positions[0], start + [0, 0.1, 0], atol=1e-9)
        sim.step_frames(4)
        np.testing.assert_allclose(sim.collider_positions[0], start + [0, 0.2, 0], atol=1e-9)
        with self.assertRaisesRegex(clothsim.UsageError, "there is no collider 7"):
            sim.move_collider(7, (0, 0, 0))

    def test_colliders_move_as_a_recording_moves_them_to_the_bit(self):
        box = {"type": "box", "origin": [0.5, 0.75, 0.5], "size": [0.5, 0.1, 0.3], "rotation": [0, 20, 10], "friction": 0.5}
        cloth = {"width": 1, "height": 1, "num_width_points": 12, "num_height_points": 12, "pinned": [[0, 0]]}
        for integrator, settings in (("verlet", {"ks": 5000}), ("implicit", {"material": "cotton"}),
                                     ("bdf2", {"material": "cotton"})):
            sim = clothsim.Simulation({"cloth": cloth | settings, "colliders": [box], "solver": {
                "integrator": integrator, "frames_per_sec": 60, "simulation_steps": 30 if integrator == "verlet" else 8}},
                backend="cpu")
            recording = {"schema": "clothsim-recording/1", "backend": "cpu", "frames": 14, "scene": sim.scene, "events": []}
            steps = recording["scene"]["solver"].get("simulation_steps", 30)
            sim.step_frames(6)
            for frame in (6, 7, 10):
                place, turn = [0.5, 0.78 + 0.004 * frame, 0.5], [0, 2.5, 1]
                sim.move_collider(0, place)
                sim.turn_collider(0, turn)
                for event in ({"action": "move_collider", "position": place}, {"action": "turn_collider", "turn": turn}):
                    recording["events"].append({"step": frame * steps, "collider": 0, **event})
                sim.step(5)
                sim.step(3 * steps - 5 if frame == 7 else steps - 5)
            sim.step_frames(3)
            self.assertNotIn("motion", sim.scene["colliders"][0], "it rests")
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, "moved.json")
                path.write_text(json.dumps(recording), encoding="utf-8")
                self.assertEqual(run_json("--replay", str(path))["state_hash"], sim.state_hash, integrator)

    def test_a_collider_turns_and_takes_the_cloth_along(self):
        sim = clothsim.Simulation("sphere", backend="cpu", resolution=(24, 24))
        sim.step_frames(90)
        place = np.array(sim.collider_positions[0])

        def directions():  # about the vertical axis
            return np.arctan2(sim.positions[:, 0] - place[0], sim.positions[:, 2] - place[2])

        on_top = sim.positions[:, 1] > place[1] + 0.15
        before = directions()
        sim.turn_collider(0, (0, 40, 0), seconds=0.5)
        sim.step_frames(90)
        np.testing.assert_allclose(sim.collider_positions[0], place, atol=1e-9)
        turned = np.degrees(directions() - before)[on_top]
        self.assertGreater(np.median((turned + 180) % 360 - 180), 20)
        with self.assertRaisesRegex(clothsim.UsageError, "turn_collider: turn: expected 0 to 180 degrees"):
            sim.turn_collider(0, (0, 200, 0))

    def test_live_keys_take_effect_and_others_are_refused(self):
        sim = clothsim.Simulation(FREE_PARTICLE, backend="cpu")
        sim.set(gravity=[2, 0, 0])
        start = np.array(sim.positions)
        sim.step(10)
        h = sim.time / 10
        np.testing.assert_allclose(sim.positions - start, np.tile([2 * h * h * 55, 0, 0], (16, 1)), atol=1e-6)
        sim.set(**{"solver.strain_limit": False, "cloth.pressure": 3, "cloth.tear_strain": 0.5})
        with self.assertRaisesRegex(clothsim.UsageError, "makes another cloth"):
            sim.set(**{"cloth.num_width_points": 5})

    def test_a_cloth_that_blows_up_goes_back_to_the_last_sound_frame(self):
        sim = clothsim.Simulation("pinned2", backend="cpu",
                                  **{"cloth.ks": 1e8, "solver.integrator": "euler", "solver.simulation_steps": 1})
        with self.assertRaisesRegex(clothsim.SimulationError, "the simulation blew up: "):
            sim.step_frames(200)
        self.assertTrue(np.isfinite(sim.positions).all())

    def test_a_blow_up_names_the_frame_whatever_the_steps_before_it_were(self):
        sim = clothsim.Simulation("pinned2", backend="cpu", resolution=(9, 9))
        sim.step_frames(3)
        sim.set(**{"solver.simulation_steps": 90})
        sim.forces = np.full(sim.positions.shape, 1e9)
        with self.assertRaisesRegex(clothsim.SimulationError, r"in step 91 \(frame 4\)"):
            sim.step_frames(2)
        sim.set(**{"solver.simulation_steps": 30})
        with self.assertRaisesRegex(clothsim.SimulationError, r"in step 91 \(frame 4\)"):
            sim.step(1)

    def test_single_steps_go_back_by_a_frame_at_most_when_cloth_blows_up(self):
        sim = clothsim.Simulation("pinned2", backend="cpu")  # 30 steps a frame
        start = sim.state_hash
        for kept in (start, None):
            if kept is None:  # what is set is what it goes back to
                sim.step(2)
                sim.set_state(sim.get_state())
                kept = sim.state_hash
            for _ in range(3):
                sim.step(1)
            sim.forces = np.full(sim.positions.shape, 1e9)
            with self.assertRaisesRegex(clothsim.SimulationError, "the simulation blew up: "):
                sim.step(1)
            sim.forces = np.zeros(sim.positions.shape)
            self.assertEqual(sim.state_hash, kept)


class OnTheGpu(NeedsOpenGl):
    def test_both_backends_agree_and_arrays_are_copies(self):
        states = []
        for backend in ("gpu", "cpu"):
            sim = clothsim.Simulation("pinned4", backend=backend, resolution=(24, 24))
            self.assertEqual(sim.backend, backend)
            sim.step_frames(1)
            sim.positions = np.array(sim.positions) + np.float32(0.25)
            pins = sim.pins
            pins[30] = True
            sim.pins = pins
            sim.step(7)
            states.append((sim.state_hash, np.array(sim.positions), np.array(sim.inverse_masses)))
        self.assertEqual(states[0][0], states[1][0])
        np.testing.assert_array_equal(states[0][1], states[1][1])
        np.testing.assert_array_equal(states[0][2], states[1][2])

    def test_both_backends_agree_on_forces(self):
        pushes = np.random.default_rng(5).normal(0, 0.02, (24 * 24, 3))
        for integrator in ("verlet", "euler", "implicit", "bdf2"):
            hashes = {}
            for backend in ("gpu", "cpu"):
                for pushed in (True, False):
                    sim = clothsim.Simulation("pinned4", backend=backend, resolution=(24, 24),
                                              **{"solver.integrator": integrator, "wind.velocity": [0, 0, 3]})
                    if pushed:
                        sim.forces = pushes
                    sim.step(4)
                    sim.forces = 2 * pushes if pushed else None
                    sim.step(4)
                    hashes[backend, pushed] = sim.state_hash
            self.assertEqual(hashes["gpu", True], hashes["cpu", True], integrator)
            self.assertEqual(hashes["gpu", False], hashes["cpu", False], integrator)
            self.assertNotEqual(hashes["gpu", True], hashes["gpu", False], integrator)

    def test_pictures_are_the_programs(self):
        sim = clothsim.Simulation("pinned4", backend="cpu", resolution=(16, 16))
        quick = sim.render(320, 180)
        picture = sim.render(320, 180, exposures=9)
        self.assertFalse(np.array_equal(quick, picture))
        np.testing.assert_array_equal(quick, sim.render(320, 180))
        self.assertEqual((picture.shape, picture.dtype), ((180, 320, 3), np.uint8))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "still.png")
            program("render", "-f", "pinned4", "--backend", "cpu", "--resolution", "16x16", "--frames", "0",
                    "--size", "320x180", "--exposures", "9", "--out", path)
            raw = subprocess.run(["convert", path, "-depth", "8", "rgb:-"], capture_output=True, check=True).stdout
        np.testing.assert_array_equal(picture, np.frombuffer(raw, np.uint8).reshape(180, 320, 3))


class Package(unittest.TestCase):
    def test_the_stub_names_what_the_module_has(self):
        stub = ast.parse(pathlib.Path(clothsim.__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
        classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
        functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
        self.assertEqual(set(classes) | functions | {"__version__"}, set(clothsim.__all__))
        members = {node.name for node in classes["Simulation"].body if isinstance(node, ast.FunctionDef)}
        public = {name for name in dir(clothsim.Simulation) if not name.startswith("_")}
        self.assertEqual(members - {"__init__"}, public)
        for name in public:
            self.assertGreater(len(getattr(clothsim.Simulation, name).__doc__ or ""), 10, name)

    def test_the_readmes_lines_run(self):
        readme = (pathlib.Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
        lines = readme.split("```python\n")[1].split("```")[0].replace("sim.render", "# sim.render")
        names = {}
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            exec(compile(lines.replace("picture = #", "#"), "README.md", "exec"), names)
        self.assertIn(names["sim"].state_hash, printed.getvalue())
        self.assertEqual(len(names["energies"]["time"]), 61)


if __name__ == "__main__":
    unittest.main()
