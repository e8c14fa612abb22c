#pragma once

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace nearfield::test {

template <class Record>
void sort_by_point(std::vector<Record>& records) {
    std::stable_sort(records.begin(), records.end(), [](const Record& i, const Record& j) {
        return std::tie(i.position.x, i.position.y) < std::tie(j.position.x, j.position.y);
    });
}

/// Calls `both(record of one, record of other)` for records at the same point and `alone(record)`
/// for the rest.
template <class Record, class Both, class Alone>
void match(std::vector<Record> one, std::vector<Record> other, const Both& both,
           const Alone& alone) {
    sort_by_point(one);
    sort_by_point(other);
    const auto key = [](const Record& record) {
        return std::pair(record.position.x, record.position.y);
    };
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < one.size() || j < other.size()) {
        if (j == other.size() || (i < one.size() && key(one[i]) < key(other[j]))) {
            alone(one[i++]);
        } else if (i == one.size() || key(other[j]) < key(one[i])) {
            alone(other[j++]);
        } else {
            both(one[i++], other[j++]);
        }
    }
}

}  // namespace nearfield::test
