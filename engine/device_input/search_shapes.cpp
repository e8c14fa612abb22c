#include <engine/device_input/search_shapes.hpp>
#include <engine/geometry/hilbert_curve.hpp>
#include <engine/queries/edge_sampler.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

namespace nearfield::device_input {

using geometry::Polygon;
using geometry::Vector;

namespace {

using FloatBox = std::array<float, 4>;  // low corner, high corner

SearchUnit unit_of(const FloatBox& floats) {
    return {std::bit_cast<std::uint32_t>(floats[0]), std::bit_cast<std::uint32_t>(floats[1]),
            std::bit_cast<std::uint32_t>(floats[2]), std::bit_cast<std::uint32_t>(floats[3])};
}

constexpr FloatBox empty_box{
    std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
    -std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};

void extend(FloatBox& box, const FloatBox& by) {
    box = {std::min(box[0], by[0]), std::min(box[1], by[1]), std::max(box[2], by[2]),
           std::max(box[3], by[3])};
}

std::uint32_t units_for(std::size_t words) {
    return static_cast<std::uint32_t>((words + 3) / 4);
}

std::uint32_t chunks_for(std::uint32_t edges) {
    return (edges + shaders::chunk_size - 1) / shaders::chunk_size;
}

}  // namespace

double unit_length_of(const Polygon& polygon) {
    constexpr std::uint64_t without_mantissa = 0xfff0'0000'0000'0000U;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(polygon.radius()) & without_mantissa);
}

float rounded_up(double value) {
    const auto rounded = static_cast<float>(value);
    return rounded < value ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
                           : rounded;
}

std::size_t SearchShapes::Hash::operator()(const Key& key) const {
    // Products spread the bits of addresses and of round lengths; the high ones are the best.
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;
    const std::uint64_t about =
        std::bit_cast<std::uint64_t>(key.length) + static_cast<std::uint64_t>(key.content);
    return ((std::bit_cast<std::uintptr_t>(key.polygon) ^ about * odd) * odd) >> 32U;
}

void SearchShapes::begin_batch() {
    ++batch_;
    drop_unused();
    units_in_use_ = 0;
}

/// Starts anew if most of what is kept was not used by the last batch, or if it is large and a good
/// part was not.
void SearchShapes::drop_unused() {
    constexpr std::size_t few = 4096;
    constexpr std::size_t many = std::size_t{1} << 22U;
    const std::size_t most =
        units_.size() > many ? units_in_use_ + units_in_use_ / 4 : 4 * units_in_use_;
    if (units_.size() > most + few) {
        clear();
    }
}

void SearchShapes::clear() {
    entries_.clear();
    recent_.fill({});
    units_.clear();
    units_in_use_ = 0;
    ++revision_;
    forget_changes();
}

/// Whoever knows an earlier revision takes all units.
void SearchShapes::forget_changes() {
    change_count_ = 0;
    changes_since_ = revision_;
}

void SearchShapes::note_change(std::uint32_t first, std::uint32_t count) {
    if (change_count_ == changes_.size()) {
        forget_changes();
    }
    changes_[change_count_++] = {++revision_, first, count};
}

void SearchShapes::copy_changes(std::uint64_t since, std::span<std::byte> memory) const {
    const auto bytes = std::as_bytes(std::span(units_));
    if (since == 0 || since < changes_since_) {
        std::copy(bytes.begin(), bytes.end(), memory.begin());
        return;
    }
    for (const Change& change : std::span(changes_).first(change_count_)) {
        if (change.revision > since) {
            const std::size_t first = sizeof(SearchUnit) * change.first;
            const auto part = bytes.subspan(first, sizeof(SearchUnit) * change.count);
            std::copy(part.begin(), part.end(),
                      memory.begin() + static_cast<std::ptrdiff_t>(first));
        }
    }
}

SearchShapes::Entry& SearchShapes::entry_of(const Key& key) {
    Recent& recent = recent_[Hash()(key) % recent_.size()];
    if (recent.entry == nullptr || !(recent.key == key)) {
        recent = {key, &entries_[key]};
    }
    return *recent.entry;
}

std::uint32_t SearchShapes::find_or_make(const Key& key) {
    Entry& entry = entry_of(key);
    if (entry.room == 0 || entry.revision != key.polygon->revision()) {
        made_.clear();
        if (key.content == Content::parts) {
            make_parts(*key.polygon, key.length);
        } else {
            list_edges(*key.polygon, key.length);
            make_shape(*key.polygon);
        }
        if (key.content == Content::field) {
            add_low_parts(*key.polygon);
        }
        const auto count = static_cast<std::uint32_t>(made_.size());
        if (entry.room < count) {
            // What grows gets twice the room, so that it leaves little behind in the long run.
            const std::size_t first = units_.size();
            const std::uint32_t room = entry.room == 0 ? count : 2 * count;
            units_.resize(first + room);
            entry.first = static_cast<std::uint32_t>(first);
            entry.room = room;
        }
        if (key.content != Content::parts) {
            // The header's places are relative to the shape until here.
            for (std::size_t i = shaders::unit_of_first_boxes; i < shaders::units_of_header; ++i) {
                for (std::uint32_t& first_box : made_[i]) {
                    first_box += entry.first;
                }
            }
            made_[0][2] += entry.first;
            made_[0][3] += 4 * entry.first;
            made_[shaders::unit_of_rings][1] += 4 * entry.first;
        }
        std::copy(made_.begin(), made_.end(), units_.begin() + entry.first);
        note_change(entry.first, count);
        entry.revision = key.polygon->revision();
    }
    if (entry.batch != batch_) {
        entry.batch = batch_;
        units_in_use_ += entry.room;
    }
    return entry.first;
}

/// The shape's own edges, or those of its simplified boundary.
void SearchShapes::list_edges(const Polygon& polygon, double deviation) {
    edges_.clear();
    ring_begin_.assign(1, 0);
    if (deviation > 0.0) {
        geometry::simplify(polygon, deviation, std::numeric_limits<double>::infinity(), edges_);
    } else {
        for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
            const std::uint32_t end = polygon.ring_end(ring);
            for (std::uint32_t edge = polygon.ring_begin(ring); edge < end; ++edge) {
                edges_.push_back({edge, edge + 1 < end ? edge + 1 : polygon.ring_begin(ring)});
            }
        }
    }
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        std::uint32_t end = ring_begin_.back();
        while (end < edges_.size() && edges_[end].first < polygon.ring_end(ring)) {
            ++end;
        }
        ring_begin_.push_back(end);
    }
}

/// Sorts the rings; where they are few their own order is as good.
void SearchShapes::order_rings(const Polygon& polygon) {
    constexpr std::uint32_t few_rings = 32;
    rings_.clear();
    const double radius = polygon.radius();
    const geometry::HilbertCurve curve({-radius, -radius, radius, radius});
    std::uint32_t chunk = 0;
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const Vector& start = polygon.vertices()[polygon.ring_begin(ring)];
        rings_.push_back({curve.at(start.x(), start.y()), ring, chunk});
        chunk += chunks_for(ring_begin_[ring + 1] - ring_begin_[ring]);
    }
    if (polygon.ring_count() >= few_rings) {
        std::sort(rings_.begin(), rings_.end(), [](const OrderedRing& i, const OrderedRing& j) {
            return i.on_curve != j.on_curve ? i.on_curve < j.on_curve : i.ring < j.ring;
        });
    }
}

/// A header, the boxes of all levels, the edges, the numbers of the edges of each chunk, where the
/// chunks are that follow each other along the rings, and those that begin a ring. The places in
/// the header are relative to its own.
void SearchShapes::make_shape(const Polygon& polygon) {
    order_rings(polygon);
    std::uint32_t chunks = 0;
    for (const OrderedRing& ring : rings_) {
        chunks += chunks_for(ring_begin_[ring.ring + 1] - ring_begin_[ring.ring]);
    }
    made_.resize(shaders::units_of_header);
    std::uint32_t levels = 0;
    std::uint32_t end = shaders::units_of_header;
    for (std::uint32_t boxes = chunks;;
         boxes = (boxes + shaders::chunk_size - 1) / shaders::chunk_size) {
        made_[shaders::unit_of_first_boxes + levels / 4][levels % 4] = end;
        ++levels;
        end += boxes;
        if (boxes <= shaders::chunk_size) {
            break;
        }
    }
    const std::uint32_t edges = end;
    const std::uint32_t infos = edges + shaders::chunk_size * chunks;
    const std::uint32_t starts = infos + 2 * units_for(chunks);
    made_[0] = {chunks, levels, edges, 4 * infos};
    const auto word_of = [](double coordinate) {
        return std::bit_cast<std::uint32_t>(static_cast<float>(coordinate));
    };
    made_[shaders::unit_of_rings] = {polygon.ring_count(), 4 * starts,
                                     word_of(polygon.centre().x()), word_of(polygon.centre().y())};
    made_.resize(starts + units_for(rings_.size()));
    boxes_.assign(chunks, empty_box);
    add_chunks(polygon, edges, infos);
    for (std::uint32_t level = 0; level < levels; ++level) {
        add_level(made_[shaders::unit_of_first_boxes + level / 4][level % 4]);
    }
    for (std::size_t i = 1; i < boxes_.size(); ++i) {
        extend(boxes_.front(), boxes_[i]);
    }
    made_[shaders::unit_of_box] = unit_of(boxes_.front());
}

void SearchShapes::add_chunks(const Polygon& polygon, std::uint32_t edges, std::uint32_t infos) {
    const std::span<const Vector> vertices = polygon.vertices();
    const double unit = unit_length_of(polygon);
    const auto end_of = [&](std::uint32_t vertex) -> std::array<float, 2> {
        const Vector place = vertices[vertex] / unit;
        return {static_cast<float>(place.x()), static_cast<float>(place.y())};
    };
    const std::uint32_t places = infos + units_for(boxes_.size());
    std::uint32_t start = made_[shaders::unit_of_rings][1];
    std::uint32_t chunk = 0;
    for (const OrderedRing& ring : rings_) {
        made_[start / 4][start % 4] = chunk;
        ++start;
        const std::uint32_t end = ring_begin_[ring.ring + 1];
        std::uint32_t along = ring.first_chunk;
        for (std::uint32_t edge = ring_begin_[ring.ring]; edge < end; ++chunk, ++along) {
            const std::uint32_t count = std::min(end - edge, shaders::chunk_size);
            made_[places + along / 4][along % 4] = chunk;
            made_[infos + chunk / 4][chunk % 4] = edge << 4U | count;
            for (std::uint32_t i = 0; i < count; ++i, ++edge) {
                const auto a = end_of(edges_[edge].first);
                const auto b = end_of(edges_[edge].last);
                const FloatBox ends{a[0], a[1], b[0], b[1]};
                made_[edges + shaders::chunk_size * chunk + i] = unit_of(ends);
                extend(boxes_[chunk], ends);
                extend(boxes_[chunk], {ends[2], ends[3], ends[0], ends[1]});
            }
        }
    }
}

/// What the rounding of their coordinates took from the edges, as these lie.
void SearchShapes::add_low_parts(const Polygon& polygon) {
    const std::span<const Vector> vertices = polygon.vertices();
    const double unit = unit_length_of(polygon);
    const auto [chunks, levels, edges, infos] = made_[0];
    const auto lost = [](double coordinate) {
        return static_cast<float>(coordinate - static_cast<double>(static_cast<float>(coordinate)));
    };
    const std::size_t first = made_.size();
    made_.resize(first + std::size_t{shaders::chunk_size} * chunks);
    for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
        const std::uint32_t info = made_[infos / 4 + chunk / 4][chunk % 4];
        for (std::uint32_t i = 0; i < (info & 15U); ++i) {
            const geometry::SimplifiedEdge& edge = edges_[(info >> 4U) + i];
            const Vector a = vertices[edge.first] / unit;
            const Vector b = vertices[edge.last] / unit;
            made_[first + std::size_t{shaders::chunk_size} * chunk + i] =
                unit_of({lost(a.x()), lost(a.y()), lost(b.x()), lost(b.y())});
        }
    }
}

/// Writes the boxes of one level, and replaces them by those of the next.
void SearchShapes::add_level(std::uint32_t first) {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        const FloatBox own = boxes_[i];
        made_[first + i] = unit_of(own);
        FloatBox& group = boxes_[i / shaders::chunk_size];
        group = i % shaders::chunk_size == 0 ? own : group;
        extend(group, own);
    }
    boxes_.resize((boxes_.size() + shaders::chunk_size - 1) / shaders::chunk_size);
}

void SearchShapes::make_parts(const Polygon& polygon, double spacing) {
    made_.resize(units_for(polygon.size()));
    queries::EdgeSampler sampler(polygon, spacing);
    for (std::uint32_t edge = 0; edge < polygon.size(); ++edge) {
        made_[edge / 4][edge % 4] = static_cast<std::uint32_t>(sampler.parts_of(edge));
    }
}

}  // namespace nearfield::device_input
