#pragma once

#include <engine/base/interruption.hpp>
#include <engine/base/jobs.hpp>
#include <engine/base/status_exception.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield {

/// Finds lists of records, one list per input, with several jobs, and puts them in the order of the
/// inputs. Besides the result, its memory depends on some thousands of inputs at a time. Keeps it.
template <class Record>
class JobLists {
public:
    /// List i becomes records[offsets[i]] to records[offsets[i + 1] - 1]. `find(job, i, list)`
    /// appends the list of input i; lists of several jobs may be asked for at the same time. Throws
    /// a StatusException (too_large) if 32 bits cannot count the records.
    template <class Find>
    void write(Jobs& jobs, std::size_t count, std::vector<std::uint32_t>& offsets,
               std::vector<Record>& records, const Find& find) {
        offsets.assign(count + 1, 0);
        records.clear();
        found_.resize(jobs.count());
        const std::size_t inputs_at_a_time = inputs_of_part * parts_of_job * jobs.count();
        for (std::size_t first = 0; first < count; first += inputs_at_a_time) {
            const std::size_t some = std::min(inputs_at_a_time, count - first);
            find_some(jobs, first, some, offsets, find);
            for (const Part& part : parts_) {
                append(part, offsets, records);
            }
        }
    }

private:
    /// What a job takes at a time: neighbours help each other.
    static constexpr std::size_t inputs_of_part = 128;
    static constexpr std::size_t parts_of_job = 8;

    /// Consecutive inputs, whose lists are consecutive among those of the job.
    struct Part {
        std::uint32_t job = 0;
        std::size_t first_input = 0;
        std::size_t end_input = 0;
        std::size_t first_point = 0;
    };

    /// Writes the size of list i in place of the offset where it ends.
    template <class Find>
    void find_some(Jobs& jobs, std::size_t first, std::size_t some,
                   std::vector<std::uint32_t>& sizes, const Find& find) {
        for (std::vector<Record>& found : found_) {
            found.clear();
        }
        parts_.assign((some + inputs_of_part - 1) / inputs_of_part, {});
        jobs.divide(
            some, inputs_of_part, [&](std::uint32_t job, std::size_t begin, std::size_t end) {
                std::vector<Record>& found = found_[job];
                parts_[begin / inputs_of_part] = {job, first + begin, first + end, found.size()};
                for (std::size_t i = first + begin; i < first + end; ++i) {
                    checkpoint();
                    const std::size_t before = found.size();
                    find(job, i, found);
                    sizes[i + 1] = static_cast<std::uint32_t>(found.size() - before);
                }
            });
    }

    void append(const Part& part, std::vector<std::uint32_t>& offsets,
                std::vector<Record>& records) const {
        std::size_t end = records.size();
        for (std::size_t i = part.first_input; i < part.end_input; ++i) {
            end += offsets[i + 1];
            if (end > UINT32_MAX) {
                throw StatusException(
                    {StatusCode::too_large, "the lists have more entries than 32 bits can count"});
            }
            offsets[i + 1] = static_cast<std::uint32_t>(end);
        }
        const auto begin = found_[part.job].begin() + static_cast<std::ptrdiff_t>(part.first_point);
        records.insert(records.end(), begin,
                       begin + static_cast<std::ptrdiff_t>(end - records.size()));
    }

    std::vector<std::vector<Record>> found_;  // by job
    std::vector<Part> parts_;                 // in the order of the inputs
};

}  // namespace nearfield
