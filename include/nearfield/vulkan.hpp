#pragma once

/// \file
/// All of nearfield, for a program that has a Vulkan device: the contents of nearfield.hpp, the
/// host's device and command buffers, and results that stay on the device.

#include <nearfield/device_poses.hpp>
#include <nearfield/diagnostics.hpp>
#include <nearfield/host.hpp>
#include <nearfield/nearfield.hpp>
#include <nearfield/on_device.hpp>
#include <nearfield/pairs_on_device.hpp>
#include <nearfield/requirements.hpp>
#include <nearfield/submission.hpp>
#include <nearfield/tile.hpp>
