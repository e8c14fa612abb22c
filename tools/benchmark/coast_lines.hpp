#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/scene.hpp>

#include <vector>

namespace nearfield::benchmark {

/// Real outlines in kilometres, compiled into the program: 3,056 and 2,250 vertices.
[[nodiscard]] std::vector<Ring> iceland();
[[nodiscard]] std::vector<Ring> ireland();

/// How far `b`, which lies to the right of `a`, can move in the direction -x before it touches `a`;
/// infinite if it passes above or below.
[[nodiscard]] double gap_along_x(const std::vector<Ring>& a, const std::vector<Ring>& b);

/// Iceland and, to the right of it, Ireland. `overlap`: how far they are pushed into each other
/// from first touch, as a fraction of Iceland's width; if negative, the gap between them.
[[nodiscard]] tools::Scene coast_lines_scene(double overlap);

}  // namespace nearfield::benchmark
