#pragma once

#include <nearfield/export.hpp>

#include <cstdint>

/// \file
/// The host's threads, for queries that the CPU answers and for making pipelines.

namespace nearfield {

/// Upper limit of JobSystem::count.
inline constexpr std::uint32_t max_jobs = 256;

/// A host's threads for the queries that the CPU answers (Technique::cpu, and query kinds that no
/// device answers) and for the pipelines that Context::create makes. The queries of a batch are
/// divided into jobs that may run concurrently. The library starts no thread of its own. By default
/// the calling thread does everything. Jobs that make pipelines call the host's Log and
/// VkAllocationCallbacks, which then have to allow calls from several threads.
///
/// Results are the same, bit for bit, for any number of jobs and threads and without a job system.
/// Not divided: a single query, work that the device does, the results read from it, and work
/// before there are queries to answer (adding shapes, finding pairs, planning).
struct JobSystem {
    void* user = nullptr;  ///< passed to `run`
    /// Maximum number of jobs per batch, 1 to `max_jobs`; 0 if `run` is not set. The number of
    /// threads is a good choice; twice that balances uneven queries better. Each job has memory of
    /// its own that is kept from batch to batch.
    std::uint32_t count = 0;
    /// Must call `job(data, 0)`, ..., `job(data, jobs - 1)`, each once, in any order, on any
    /// threads, concurrently or not, and return when all have returned and their writes are visible
    /// to the caller. Jobs do not wait for each other and do not throw. Called by the thread that
    /// called Context::create, submit, record, collect or run, or a function of a World, during
    /// that call; it must not throw or call the context. `jobs` is at least 2 and at most `count`.
    void (*run)(void* user, std::uint32_t jobs, void (*job)(void* data, std::uint32_t number),
                void* data) = nullptr;
};

}  // namespace nearfield
