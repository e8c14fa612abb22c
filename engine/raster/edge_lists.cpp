#include <engine/base/interruption.hpp>
#include <engine/raster/edge_lists.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace nearfield::raster {
namespace {

using geometry::Vector;

/// A run's vertices and its straight edge are rounded to floats separately.
constexpr double deviation_slack = 1.0 / 1024.0;

/// The part of an edge with |x| and |y| at most `extent`, if there is one.
std::optional<queries::TileEdge> cut(const queries::TileEdge& edge, double extent) {
    if (std::max(edge.a.cwiseAbs().maxCoeff(), edge.b.cwiseAbs().maxCoeff()) <= extent) {
        return edge;
    }
    double from = 0.0;
    double to = 1.0;
    const Vector d = edge.b - edge.a;
    for (int axis = 0; axis < 2; ++axis) {
        if (d[axis] == 0.0) {
            if (std::abs(edge.a[axis]) > extent) {
                return std::nullopt;
            }
        } else {
            const double enter = (-extent - edge.a[axis]) / d[axis];
            const double leave = (extent - edge.a[axis]) / d[axis];
            from = std::max(from, std::min(enter, leave));
            to = std::min(to, std::max(enter, leave));
        }
    }
    if (from > to) {
        return std::nullopt;
    }
    // An end that needs no cut keeps its exact coordinates: neighbouring edges share it.
    return queries::TileEdge{from == 0.0 ? edge.a : Vector(edge.a + from * d),
                             to == 1.0 ? edge.b : Vector(edge.a + to * d), edge.simplified};
}

shaders::EdgeData straight(const queries::TileEdge& edge) {
    shaders::EdgeData data;
    data.a.x = static_cast<float>(edge.a.x());
    data.a.y = static_cast<float>(edge.a.y());
    data.b.x = static_cast<float>(edge.b.x());
    data.b.y = static_cast<float>(edge.b.y());
    return data;
}

}  // namespace

void EdgeListWriter::begin_tile(const queries::TileBoundary& boundary) {
    boundary_ = &boundary;
    ++tile_;
    if (runs_.size() < boundary.size()) {
        runs_.resize(boundary.size());
    }
}

std::uint32_t EdgeListWriter::run_of(const geometry::SimplifiedEdge& edge, std::uint32_t index) {
    WrittenRun& run = runs_[index];
    if (run.tile != tile_) {
        run = {tile_, static_cast<std::uint32_t>(geometry_.size())};
        const auto vertices = boundary_->simplified().polygon->vertices();
        for (std::uint32_t i = 0; i < edge.count; ++i) {
            const Vector v = boundary_->to_cells()(vertices[edge.first + i]);
            geometry_.push_back({static_cast<float>(v.x()), static_cast<float>(v.y())});
        }
        const Vector v = boundary_->end(index);
        geometry_.push_back({static_cast<float>(v.x()), static_cast<float>(v.y())});
    }
    return run.place;
}

shaders::EdgeData EdgeListWriter::describe(const queries::TileEdge& edge) {
    shaders::EdgeData data = straight(edge);
    if (edge.simplified != queries::no_simplified) {
        const geometry::SimplifiedEdge& simplified = boundary_->edge(edge.simplified);
        data.first_edge = simplified.first;
        if (simplified.count > 1) {
            data.run = run_of(simplified, edge.simplified);
            data.run_count = simplified.count;
            data.deviation = static_cast<float>(boundary_->to_cells().cells(simplified.deviation) +
                                                deviation_slack);
        }
    }
    return data;
}

shaders::EdgeListData EdgeListWriter::write(const std::vector<queries::TileEdge>& edges,
                                            double extent) {
    list_.clear();
    SparseCheckpoint<256> checkpoint;
    for (const queries::TileEdge& edge : edges) {
        checkpoint.step();
        const bool exact = edge.simplified == queries::no_simplified ||
                           boundary_->edge(edge.simplified).count == 1;
        if (!exact) {
            list_.push_back(describe(edge));
        } else if (const auto part = cut(edge, extent)) {
            list_.push_back(describe(*part));
        }
    }
    return write_list();
}

shaders::EdgeListData EdgeListWriter::write_list() {
    if (geometry_.size() % 2 != 0) {
        geometry_.emplace_back();  // edges and boxes are read four numbers at a time
    }
    shaders::EdgeListData result;
    result.count = static_cast<std::uint32_t>(list_.size());
    result.edges = static_cast<std::uint32_t>(geometry_.size());
    constexpr std::size_t entries_of_an_edge = sizeof(shaders::EdgeData) / sizeof(Entry);
    geometry_.resize(result.edges + entries_of_an_edge * list_.size());
    std::memcpy(static_cast<void*>(geometry_.data() + result.edges), list_.data(),
                sizeof(shaders::EdgeData) * list_.size());
    result.clusters = static_cast<std::uint32_t>(geometry_.size());
    for (std::size_t first = 0; first < list_.size(); first += shaders::cluster_size) {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        Entry low{infinity, infinity};
        Entry high{-infinity, -infinity};
        const std::size_t end = std::min<std::size_t>(first + shaders::cluster_size, list_.size());
        for (std::size_t i = first; i < end; ++i) {
            const shaders::EdgeData& edge = list_[i];
            low.x = std::min(low.x, std::min(edge.a.x, edge.b.x) - edge.deviation);
            low.y = std::min(low.y, std::min(edge.a.y, edge.b.y) - edge.deviation);
            high.x = std::max(high.x, std::max(edge.a.x, edge.b.x) + edge.deviation);
            high.y = std::max(high.y, std::max(edge.a.y, edge.b.y) + edge.deviation);
        }
        geometry_.push_back(low);
        geometry_.push_back(high);
    }
    return result;
}

}  // namespace nearfield::raster
