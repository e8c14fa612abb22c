#pragma once

#include <nearfield/shape.hpp>

#include <tools/input/scene.hpp>

#include <vector>

namespace nearfield::benchmark {

/// Real outlines, in kilometres: 3,056 and 2,250 vertices. The program carries them.
[[nodiscard]] std::vector<Ring> iceland();
[[nodiscard]] std::vector<Ring> ireland();

/// How far `b`, which lies right of all of `a`, can go in the direction of -x until it touches `a`;
/// infinite where it passes above or below.
[[nodiscard]] double gap_along_x(const std::vector<Ring>& a, const std::vector<Ring>& b);

/// Iceland and, to the right of it, Ireland. `overlap`: how far they are pushed into each other
/// from where they touch, as a share of Iceland's width; negative: apart by as much.
[[nodiscard]] tools::Scene coast_lines_scene(double overlap);

}  // namespace nearfield::benchmark
