#pragma once

#include <nearfield/export.hpp>

/// \file
/// A device of the context's own, and the log of any context. No type of Vulkan's.

namespace nearfield {

/// Severity of a message.
enum class LogLevel {
    information,  ///< creation and destruction, the device, pipelines with their build times
    warning,      ///< memory or images grew after start-up, which can delay a frame
    error,        ///< device loss; a shader to be reloaded does not compile
};

/// Receives log messages. Silent by default. When `write` is set: creation and destruction,
/// pipeline build times, growth, device loss.
///
/// `write` is called by the thread that called the library, during that call, and by the jobs that
/// make pipelines (Settings::jobs), which may run concurrently. It must not throw or call the
/// context. `message` is one line without a line break, valid during the call.
struct Log {
    void* user = nullptr;  ///< passed to `write`
    /// Receives one message.
    void (*write)(void* user, LogLevel level, const char* message) = nullptr;
};

/// Selects the device of a headless context.
struct HeadlessOptions {
    /// A part of the device's name, case-sensitive; null or empty: the best kind available
    /// (discrete, integrated, virtual, then a CPU implementation such as lavapipe).
    const char* device_name = nullptr;
    Log log = {};  ///< receives messages
};

}  // namespace nearfield
