"""Tests that need OpenGL: where there is none, they are skipped and say why."""
import unittest

import clothsim


class NeedsOpenGl(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        try:
            clothsim.Simulation("pinned4", backend="gpu", resolution=(8, 8))
        except clothsim.OpenGlError as error:
            raise unittest.SkipTest(str(error))
