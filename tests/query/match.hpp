#pragma once

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace nearfield::test {

/// Vertices of a boundary that meet in a point are told apart by their normals.
template <class Record>
void sort_by_point(std::vector<Record>& records) {
    std::stable_sort(records.begin(), records.end(), [](const Record& i, const Record& j) {
        const auto key = [](const Record& record) {
            if constexpr (requires { record.normal; }) {
                return std::tie(record.position.x, record.position.y, record.normal.x,
                                record.normal.y);
            } else {
                return std::tie(record.position.x, record.position.y);
            }
        };
        return key(i) < key(j);
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
