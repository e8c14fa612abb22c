#include "overlap.hpp"

#include <geos_c.h>
#include <tests/oracle/plane.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace nearfield::oracle {
namespace {

/// One GEOS handle for the duration of a query; its errors become exceptions.
class Geos {
public:
    Geos() : handle_(GEOS_init_r()) {
        GEOSContext_setErrorMessageHandler_r(handle_, &Geos::keep_message, &message_);
    }
    ~Geos() { GEOS_finish_r(handle_); }
    Geos(const Geos&) = delete;
    Geos& operator=(const Geos&) = delete;

    struct Deleter {
        GEOSContextHandle_t handle;
        void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
    };
    using Geometry = std::unique_ptr<GEOSGeometry, Deleter>;

    [[nodiscard]] GEOSContextHandle_t handle() const { return handle_; }
    [[nodiscard]] Geometry own(GEOSGeometry* geometry) const {
        require(geometry != nullptr);
        return {geometry, Deleter{handle_}};
    }
    void require(bool success) const {
        if (!success) {
            throw std::runtime_error("GEOS: " + message_);
        }
    }

private:
    static void keep_message(const char* message, void* text) {
        *static_cast<std::string*>(text) = message;
    }
    GEOSContextHandle_t handle_;
    std::string message_;
};
using Geometry = Geos::Geometry;

/// A closed line through the vertices first, ..., last - 1.
GEOSCoordSequence* closed_line(const Geos& geos, const ShapeOracle& shape, std::uint32_t first,
                               std::uint32_t last, const Vector2& origin) {
    GEOSCoordSequence* line = GEOSCoordSeq_create_r(geos.handle(), last - first + 1, 2);
    const Vector2 shift = minus(shape.origin(), origin);
    for (std::uint32_t i = first; i <= last; ++i) {
        const Vector2 v = plus(shape.local_vertices()[i < last ? i : first], shift);
        GEOSCoordSeq_setXY_r(geos.handle(), line, i - first, v.x, v.y);
    }
    return line;
}

/// Calls `use(first, last)` for each ring.
template <class Use>
void for_each_ring(const ShapeOracle& shape, const Use& use) {
    const auto begins = shape.ring_begins();
    for (std::size_t ring = 0; ring < begins.size(); ++ring) {
        use(begins[ring], ring + 1 < begins.size() ? begins[ring + 1] : shape.size());
    }
}

/// All edges as lines.
Geometry lines_of(const Geos& geos, const ShapeOracle& shape, const Vector2& origin) {
    std::vector<GEOSGeometry*> lines;
    for_each_ring(shape, [&](std::uint32_t first, std::uint32_t last) {
        lines.push_back(GEOSGeom_createLineString_r(geos.handle(),
                                                    closed_line(geos, shape, first, last, origin)));
    });
    return geos.own(GEOSGeom_createCollection_r(geos.handle(), GEOS_MULTILINESTRING, lines.data(),
                                                static_cast<unsigned>(lines.size())));
}

/// The polygons of a geometry; drops lines and points left by the repair.
Geometry polygons_of(const Geos& geos, const GEOSGeometry& geometry) {
    std::vector<GEOSGeometry*> polygons;
    const auto collect = [&](const auto& self, const GEOSGeometry* part) -> void {
        const int type = GEOSGeomTypeId_r(geos.handle(), part);
        if (type == GEOS_POLYGON) {
            polygons.push_back(GEOSGeom_clone_r(geos.handle(), part));
        } else if (type >= GEOS_MULTIPOINT) {
            for (int i = 0; i < GEOSGetNumGeometries_r(geos.handle(), part); ++i) {
                self(self, GEOSGetGeometryN_r(geos.handle(), part, i));
            }
        }
    };
    collect(collect, &geometry);
    return geos.own(GEOSGeom_createCollection_r(geos.handle(), GEOS_MULTIPOLYGON, polygons.data(),
                                                static_cast<unsigned>(polygons.size())));
}

/// The valid multipolygon of all rings under the odd-even rule: each ring is repaired by its own
/// line work, and rings are combined by symmetric difference.
Geometry filled(const Geos& geos, const ShapeOracle& shape, const Vector2& origin) {
    Geometry sum{nullptr, Geos::Deleter{geos.handle()}};
    for_each_ring(shape, [&](std::uint32_t first, std::uint32_t last) {
        GEOSGeometry* outline = GEOSGeom_createLinearRing_r(
            geos.handle(), closed_line(geos, shape, first, last, origin));
        const Geometry raw = geos.own(GEOSGeom_createPolygon_r(geos.handle(), outline, nullptr, 0));
        const Geometry repaired = geos.own(GEOSMakeValid_r(geos.handle(), raw.get()));
        Geometry part = polygons_of(geos, *repaired);
        if (sum) {
            const Geometry both =
                geos.own(GEOSSymDifference_r(geos.handle(), sum.get(), part.get()));
            part = polygons_of(geos, *both);
        }
        sum = std::move(part);
    });
    return sum;
}

double area_of(const Geos& geos, const Geometry& geometry) {
    double value = 0.0;
    geos.require(GEOSArea_r(geos.handle(), geometry.get(), &value) == 1);
    return value;
}

/// Points of every part of a geometry: the vertices of its lines and the points halfway between
/// them, and an inner point of each polygon.
std::vector<Vector2> points_of(const Geos& geos, const GEOSGeometry& geometry) {
    std::vector<Vector2> points;
    const auto add = [&](const GEOSGeometry* of) {
        const GEOSCoordSequence* line = GEOSGeom_getCoordSeq_r(geos.handle(), of);
        unsigned count = 0;
        geos.require(GEOSCoordSeq_getSize_r(geos.handle(), line, &count) == 1);
        for (unsigned i = 0; i < count; ++i) {
            Vector2 at;
            geos.require(GEOSCoordSeq_getXY_r(geos.handle(), line, i, &at.x, &at.y) == 1);
            if (i > 0) {
                points.push_back(times(plus(points.back(), at), 0.5));
            }
            points.push_back(at);
        }
    };
    const auto collect = [&](const auto& self, const GEOSGeometry* part) -> void {
        const int type = GEOSGeomTypeId_r(geos.handle(), part);
        if (type == GEOS_POLYGON) {
            const Geometry inner = geos.own(GEOSPointOnSurface_r(geos.handle(), part));
            if (GEOSisEmpty_r(geos.handle(), inner.get()) == 0) {
                add(inner.get());
            }
        } else if (type >= GEOS_MULTIPOINT) {
            for (int i = 0; i < GEOSGetNumGeometries_r(geos.handle(), part); ++i) {
                self(self, GEOSGetGeometryN_r(geos.handle(), part, i));
            }
        } else if (GEOSisEmpty_r(geos.handle(), part) == 0) {
            add(part);
        }
    };
    collect(collect, &geometry);
    return points;
}

bool holds_a_ring(const ShapeOracle& outer, const ShapeOracle& inner) {
    return std::any_of(inner.ring_begins().begin(), inner.ring_begins().end(),
                       [&](std::uint32_t first) { return outer.contains(inner.vertex(first)); });
}

}  // namespace

double area(const ShapeOracle& shape) {
    const Geos geos;
    return area_of(geos, filled(geos, shape, shape.origin()));
}

Overlap overlap(const ShapeOracle& a, const ShapeOracle& b) {
    const Geos geos;
    const Geometry filled_a = filled(geos, a, a.origin());
    const Geometry filled_b = filled(geos, b, a.origin());
    const Geometry both =
        geos.own(GEOSIntersection_r(geos.handle(), filled_a.get(), filled_b.get()));
    Overlap result;
    result.area = area_of(geos, both);
    if (result.area > 0.0) {
        geos.require(GEOSGeom_getExtent_r(geos.handle(), both.get(), &result.box.min.x,
                                          &result.box.min.y, &result.box.max.x,
                                          &result.box.max.y) == 1);
        result.box = {plus(result.box.min, a.origin()), plus(result.box.max, a.origin())};
    }
    return result;
}

bool intersects(const ShapeOracle& a, const ShapeOracle& b) {
    const Geos geos;
    const Geometry lines_a = lines_of(geos, a, a.origin());
    const Geometry lines_b = lines_of(geos, b, a.origin());
    const GEOSPreparedGeometry* prepared = GEOSPrepare_r(geos.handle(), lines_a.get());
    geos.require(prepared != nullptr);
    const char meet = GEOSPreparedIntersects_r(geos.handle(), prepared, lines_b.get());
    GEOSPreparedGeom_destroy_r(geos.handle(), prepared);
    geos.require(meet != 2);
    return meet == 1 || holds_a_ring(a, b) || holds_a_ring(b, a);
}

double protrusion(const ShapeOracle& a, const ShapeOracle& b) {
    const Geos geos;
    const Geometry filled_b = filled(geos, b, a.origin());
    double most = 0.0;
    const auto examine = [&](const Geometry& part) {
        const Geometry outside =
            geos.own(GEOSDifference_r(geos.handle(), part.get(), filled_b.get()));
        for (const Vector2& local : points_of(geos, *outside)) {
            // GEOS rounds; the point itself is judged.
            const Vector2 point = plus(local, a.origin());
            const double from_a = a.contains(point) ? 0.0 : a.nearest(point).distance;
            const double from_b = b.contains(point) ? 0.0 : b.nearest(point).distance;
            most = std::max(most, from_b - from_a);
        }
    };
    examine(filled(geos, a, a.origin()));
    examine(lines_of(geos, a, a.origin()));
    return most;
}

double boundary_distance(const ShapeOracle& a, const ShapeOracle& b) {
    const Geos geos;
    const Geometry lines_a = lines_of(geos, a, a.origin());
    const Geometry lines_b = lines_of(geos, b, a.origin());
    double value = 0.0;
    geos.require(GEOSDistanceIndexed_r(geos.handle(), lines_a.get(), lines_b.get(), &value) == 1);
    return value;
}

std::optional<Pose> pose_for_overlap(const ShapeOracle& a, std::span<const Ring> b, double angle,
                                     const Vector2& direction, double share) {
    const ShapeOracle turned(b, {{}, angle});
    const double wanted = share * std::min(area(a), area(turned));
    const Vector2 start = minus(a.origin(), turned.origin());
    const Vector2 unit = times(direction, 1.0 / length(direction));
    const auto moved = [&](double step) { return Pose{plus(start, times(unit, step)), angle}; };
    const auto excess = [&](double step) {
        return overlap(a, ShapeOracle(b, moved(step))).area - wanted;
    };
    const auto radius = [](const ShapeOracle& shape) {
        return distance(shape.box().min, shape.box().max) / 2;
    };
    double near = 0.0;
    double far = radius(a) + radius(turned);
    if (excess(near) < 0.0) {
        return std::nullopt;
    }
    while (far - near > 1e-15 * far) {
        const double between = (near + far) / 2;
        const double here = excess(between);
        if (std::abs(here) <= 1e-6 * wanted) {
            return moved(between);
        }
        (here > 0.0 ? near : far) = between;
    }
    return moved(near);
}

}  // namespace nearfield::oracle
