"""The Python package among other things of its process: memory without a simulation, threads, signals, the user's language, OpenGL."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import clothsim
from needs_opengl import NeedsOpenGl


class Initialization(unittest.TestCase):
    def test_what_was_not_initialized_says_so_until_it_is(self):
        sim = clothsim.Simulation.__new__(clothsim.Simulation)
        arguments = {"run": (1,), "move_collider": (0, (0, 0, 0)), "turn_collider": (0, (0, 0, 0)), "save": ("no.state",),
                     "load": ("no.state",), "set_state": (b"",)}
        for name in dir(clothsim.Simulation):
            if not name.startswith("_"):
                with self.subTest(name=name), self.assertRaisesRegex(TypeError, "holds no simulation"):
                    getattr(sim, name)(*arguments.get(name, ()))
        for name in ("positions", "velocities", "forces", "pins"):
            with self.subTest(name=name), self.assertRaisesRegex(TypeError, "holds no simulation"):
                setattr(sim, name, np.zeros((4, 3)))
        with self.assertRaisesRegex(TypeError, "holds no simulation"):
            repr(sim)
        with self.assertRaisesRegex(clothsim.UsageError, "backend: expected"):
            sim.__init__("pinned2", backend="none")
        with self.assertRaisesRegex(TypeError, "holds no simulation"):
            sim.step()
        sim.__init__("pinned2", backend="cpu", resolution=(4, 4))
        sim.step_frames(2)
        self.assertEqual(sim.frame, 2)


class Threads(unittest.TestCase):
    def test_other_threads_run_while_it_steps_and_must_not_touch_it(self):
        sim = clothsim.Simulation("pinned2", backend="cpu", resolution=(128, 128))

        def step():
            while True:
                try:
                    return sim.step_frames(8)
                except clothsim.UsageError:  # the other thread was first
                    pass

        stepping = threading.Thread(target=step)
        stepping.start()
        said = ""
        # A thread that steps without letting others run is never met in a step.
        while stepping.is_alive() and not said:
            try:
                sim.step()
            except clothsim.UsageError as error:
                said = str(error)
        stepping.join()
        self.assertIn("another thread uses this simulation", said)

    def test_another_thread_may_reset_it_while_it_is_read(self):
        code = """if True:
            import contextlib, sys, threading, time, clothsim
            sys.setswitchinterval(1e-6)
            sim = clothsim.Simulation("pinned2", backend="cpu", resolution=(2, 2))
            ends = time.monotonic() + 4
            def reset():
                while time.monotonic() < ends:
                    with contextlib.suppress(clothsim.UsageError):  # the other thread was first
                        sim.reset()
            resetting = threading.Thread(target=reset)
            resetting.start()
            read = 0
            while time.monotonic() < ends:
                for name in ("scene", "scene", "time", "frame", "device", "forces", "collider_positions", "positions"):
                    with contextlib.suppress(clothsim.UsageError):
                        read += len(str(getattr(sim, name))) > 0
                repr(sim)
            resetting.join()
            print(read > 0)
        """
        told = subprocess.run([sys.executable, "-c", code], env={**os.environ, "MALLOC_PERTURB_": "165"},  # what is freed is garbage
                              capture_output=True, text=True, check=False)
        self.assertEqual((told.returncode, told.stdout), (0, "True\n"), told.stderr)

    def test_threads_may_ask_for_the_first_array_at_once(self):
        code = """if True:
            import threading, clothsim
            together, lengths = threading.Barrier(3), []
            def ask():
                sim = clothsim.Simulation("pinned2", backend="cpu", resolution=(4, 4))
                together.wait()
                lengths.append(len(sim.positions))
            threads = [threading.Thread(target=ask) for _ in range(3)]
            for thread in threads: thread.start()
            for thread in threads: thread.join()
            print(lengths)
        """
        told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
        self.assertEqual((told.returncode, told.stdout), (0, "[16, 16, 16]\n"), told.stderr)

    def test_while_it_steps_others_are_told_so_and_see_what_it_is(self):
        sim = clothsim.Simulation("pinned2", backend="cpu", resolution=(128, 128))
        stepping = threading.Thread(target=lambda: sim.step_frames(20))
        stepping.start()
        said = ""
        while stepping.is_alive() and not said:
            try:
                float(sim.time)
            except clothsim.UsageError as error:
                said = str(error)
                self.assertEqual(repr(sim), "<clothsim.Simulation: 16384 particles, cpu, in use by another thread>")
                self.assertEqual(sim.backend, "cpu")
        stepping.join()
        self.assertIn("another thread uses this simulation", said)


class ThreadsWithOpenGl(NeedsOpenGl):
    def test_it_belongs_to_its_thread(self):
        sim = clothsim.Simulation("pinned4", backend="gpu", resolution=(8, 8))
        said = []

        def elsewhere():
            try:
                sim.step()
            except clothsim.UsageError as error:
                said.append(str(error))

        thread = threading.Thread(target=elsewhere)
        thread.start()
        thread.join()
        self.assertIn("belongs to the thread", said[0])

    def test_auto_takes_the_cpu_where_another_thread_has_opengl(self):
        here = clothsim.Simulation("pinned4", backend="gpu", resolution=(8, 8))
        made = []
        thread = threading.Thread(target=lambda: made.append(clothsim.Simulation("pinned4", resolution=(8, 8))))
        thread.start()
        thread.join()
        self.assertEqual((here.backend, made[0].backend), ("gpu", "cpu"))

    def test_one_of_the_threads_that_ask_at_once_gets_opengl(self):
        code = """if True:
            import threading, clothsim
            together, said = threading.Barrier(4), []
            def make():
                together.wait()
                try:
                    said.append(clothsim.Simulation("pinned4", backend="gpu", resolution=(8, 8)).backend)
                    together.wait()
                except clothsim.UsageError as error:
                    said.append(str(error))
                    together.wait()
            threads = [threading.Thread(target=make) for _ in range(4)]
            for thread in threads: thread.start()
            for thread in threads: thread.join()
            print(sorted(said))
        """
        told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
        self.assertEqual(told.stdout.count("OpenGL is used by another thread"), 3, told.stdout + told.stderr)


class Process(unittest.TestCase):
    def test_ctrl_c_ends_a_long_step_at_a_whole_step(self):
        sim = clothsim.Simulation("pinned2", backend="cpu")
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            sim.step_frames(1_000_000)
        self.assertLess(time.monotonic() - began, 3)
        steps = round(sim.time * 90 * 30)
        again = clothsim.Simulation("pinned2", backend="cpu")
        again.step(steps)
        self.assertGreater(steps, 0)
        self.assertEqual(again.state_hash, sim.state_hash)

    def test_the_process_ends_while_daemon_threads_step(self):
        for steps in ("sim.step_frames(1_000_000)", "sim.step()", "sim.run(1)", "sim.reset()"):
            code = f"""if True:
                import threading, time, clothsim
                def step():
                    sim = clothsim.Simulation("pinned2", backend="cpu", resolution=(24, 24))
                    stepping.set()
                    while True:
                        {steps}
                for _ in range(3):
                    stepping = threading.Event()
                    threading.Thread(target=step, daemon=True).start()
                    stepping.wait()
                time.sleep(0.1)
                print("the end")
            """
            with self.subTest(steps=steps):
                told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
                self.assertEqual((told.returncode, told.stdout, told.stderr), (0, "the end\n", ""))

    def test_numbers_have_a_point_whatever_the_users_language(self):
        language = "de_DE.UTF-8"
        with tempfile.TemporaryDirectory() as folder:
            if not shutil.which("localedef") or subprocess.run(
                ["localedef", "-i", "de_DE", "-f", "UTF-8", os.path.join(folder, language)], capture_output=True, check=False
            ).returncode:
                self.skipTest("no locale can be made here")
            code = (f"import locale, clothsim; locale.setlocale(locale.LC_ALL, '{language}'); assert locale.str(0.5) == '0,5';"
                    "print(clothsim.Simulation({'cloth': {'ks': 1000.5}}, backend='cpu').scene['cloth']['ks'])")
            told = subprocess.run([sys.executable, "-c", code], env={**os.environ, "LOCPATH": folder}, capture_output=True,
                                  text=True, check=False)
        self.assertEqual(told.stdout, "1000.5\n", told.stderr)

    def test_the_cpu_backend_opens_no_opengl(self):
        code = ("import clothsim; clothsim.Simulation('pinned2', backend='cpu').step();"
                "print('libEGL' in open('/proc/self/maps').read())")
        told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        self.assertEqual(told.stdout.strip(), "False")


if __name__ == "__main__":
    unittest.main()
