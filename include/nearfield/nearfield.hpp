#pragma once

/// \file
/// Everything that needs no Vulkan types: shapes, queries, batches and worlds, answered by the CPU
/// or by a device that the context creates. To use your own Vulkan device, include vulkan.hpp.
///
/// Begin with Context (context.hpp), Ring (shape.hpp), the queries (query.hpp) and their results
/// (result.hpp); then Batch and Results; then World and its tables of pairs (world.hpp).

#include <nearfield/context.hpp>
#include <nearfield/curve.hpp>
#include <nearfield/fill.hpp>
#include <nearfield/headless.hpp>
#include <nearfield/jobs.hpp>
#include <nearfield/limits.hpp>
#include <nearfield/localization.hpp>
#include <nearfield/portable_math.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>
#include <nearfield/version.hpp>
#include <nearfield/world.hpp>
#include <nearfield/world_pairs.hpp>
#include <nearfield/world_queries.hpp>
#include <nearfield/world_request.hpp>
