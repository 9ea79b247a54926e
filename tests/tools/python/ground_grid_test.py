# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
import unittest

from drive import CAPTURE

import numpy as np
import terracut


class GroundGrid(unittest.TestCase):
    def test_the_ground_of_a_street_is_level_where_it_was_seen(self):
        frame = next(terracut.replay(CAPTURE, heights=True, mount_height=1.73, mount_roll=0, mount_pitch=0))
        grid = terracut.GroundGrid(cell_m=0.5, reach_m=20)
        grid.update(frame.points, frame.labels, frame.height_above_ground_m)
        self.assertEqual((grid.height_m.shape, grid.height_m.dtype), ((80, 80), np.float32))
        seen, unknown = grid.known == grid.SEEN, grid.known == grid.UNKNOWN
        self.assertGreater(seen.sum(), 1000)
        self.assertGreater((grid.known == grid.INTERPOLATED).sum(), 100)
        np.testing.assert_array_equal(np.isnan(grid.height_m), unknown)
        # A row is a step ahead, a column a step to the left.
        x, y = frame.points[:, 0], frame.points[:, 1]
        near = (np.abs(x) < 20) & (np.abs(y) < 20) & (frame.labels == terracut.GROUND)
        row, column = ((x[near] + 20) * 2).astype(int), ((y[near] + 20) * 2).astype(int)
        self.assertTrue(seen[row, column].all())
        self.assertLess(np.median(np.abs(grid.height_m[row, column] - frame.points[near, 2])), 0.03)
        self.assertLess(np.nanmedian(grid.slope_deg[seen]), 5)

    def test_made_up_points_have_the_slope_that_they_were_made_with(self):
        x, y = np.meshgrid(np.arange(-9.75, 10, 0.5), np.arange(-9.75, 10, 0.5))
        points = np.stack([x.ravel(), y.ravel(), 0.1 * x.ravel()], axis=1)
        grid = terracut.GroundGrid(cell_m=0.5, reach_m=10)
        grid.update(points, np.full(len(points), terracut.GROUND), np.zeros(len(points)))
        np.testing.assert_allclose(grid.slope_deg, np.degrees(np.arctan(0.1)), atol=0.01)
        np.testing.assert_allclose(grid.height_m[:, 0], 0.1 * x[0], atol=1e-5)
        kept = grid.height_m
        grid.update(points[:0], [], [])
        self.assertTrue((grid.known == grid.UNKNOWN).all())
        self.assertTrue(np.isfinite(kept).all(), "arrays are copies")

    def test_what_does_not_fit_is_refused(self):
        with self.assertRaisesRegex(terracut.InvalidArgument, "cells of 0 m"):
            terracut.GroundGrid(cell_m=0)
        grid = terracut.GroundGrid()
        with self.assertRaisesRegex(terracut.InvalidArgument, "2 points came with 1 labels and 0 heights"):
            grid.update(np.zeros((2, 3)), [terracut.GROUND], [])
        with self.assertRaisesRegex(ValueError, "points"):
            grid.update(np.zeros(6), [terracut.GROUND], [0.0])
        with self.assertRaises(TypeError, msg="what a frame without heights has"):
            grid.update(np.zeros((1, 3)), [terracut.GROUND], None)


if __name__ == "__main__":
    unittest.main()
