#pragma once

#include <cstdint>

/// \file
/// How a host lends its threads.

namespace nearfield {

/// The most jobs that a batch's work on the CPU is divided into.
inline constexpr std::uint32_t most_jobs = 256;

/// A host's own threads, for the queries that the CPU answers (Technique::cpu, and what no device
/// answers): the queries of a batch are divided into jobs, which may be done at the same time. The
/// library starts no thread. Left out, everything is done by the thread that calls.
///
/// Results are the same, bit for bit, with any number of jobs and threads and without any. What a
/// device answers, and what is done before there are queries to answer (shapes handed over, pairs
/// found, planning), is not divided; nor is a single query.
struct JobSystem {
    void* user = nullptr;  ///< handed back with each call
    /// How many jobs at the most a batch is divided into, 1 to `most_jobs`; 0 without `run`. Each
    /// has memory of its own that is kept from batch to batch; there are fewer where
    /// Settings::memory_limit has no room for what each needs. As many as there are threads is a
    /// good number; twice that evens out better what queries take.
    std::uint32_t count = 0;
    /// Calls `job(data, 0)`, ..., `job(data, jobs - 1)`, each once, in any order, on any threads
    /// and at the same time if it likes, and returns when all have returned, so that what they
    /// wrote is seen by who called. No job waits for another, or throws. Called by the thread that
    /// called Context::submit, record or run, inside that call; it must not throw and must not call
    /// the context. `jobs` is at least 2 and at most `count`.
    void (*run)(void* user, std::uint32_t jobs, void (*job)(void* data, std::uint32_t number),
                void* data) = nullptr;
};

}  // namespace nearfield
