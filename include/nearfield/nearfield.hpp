#pragma once

/// \file
/// Includes the whole public API of nearfield.

#include <nearfield/context.hpp>
#include <nearfield/curve.hpp>
#include <nearfield/device_poses.hpp>
#include <nearfield/diagnostics.hpp>
#include <nearfield/fill.hpp>
#include <nearfield/host.hpp>
#include <nearfield/jobs.hpp>
#include <nearfield/limits.hpp>
#include <nearfield/localization.hpp>
#include <nearfield/portable_math.hpp>
#include <nearfield/query.hpp>
#include <nearfield/requirements.hpp>
#include <nearfield/resident.hpp>
#include <nearfield/resident_pairs.hpp>
#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>
#include <nearfield/submission.hpp>
#include <nearfield/tile.hpp>
#include <nearfield/version.hpp>
#include <nearfield/world.hpp>
#include <nearfield/world_pairs.hpp>
#include <nearfield/world_queries.hpp>
#include <nearfield/world_request.hpp>
