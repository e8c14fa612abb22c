#include <nearfield/portable_math.hpp>
#include <nearfield/shape.hpp>

#include <tools/io/arc_chain.hpp>
#include <tools/io/dxf.hpp>
#include <tools/io/dxf_curves.hpp>
#include <tools/io/dxf_values.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

/// Entities that stand together: a block, or model space.
struct DxfBlock {
    std::vector<DxfEntity> entities = {};
    Vector2 base = {};  ///< the point that an INSERT puts at its place
    enum class State { unread, in_progress, done } state = State::unread;
    CurvePath path = {};
    std::size_t segments = 0;  ///< of the path
};

class DxfReader : private DxfValues {
    // Blocks in blocks multiply: a small file must not take all memory.
    static constexpr std::size_t most_segments = std::size_t{1} << 18U;

public:
    DxfReader(const std::string& text, const std::string& file, SkippedParts& skipped)
        : DxfValues(text, file), skipped_(skipped) {}

    CurvePath read(LengthUnit unit) {
        const std::vector<DxfEntity> all = read_dxf_entities(groups());
        if (all.empty() || all.front().type != "SECTION") {
            fail(0, "a DXF file begins with a section");
        }
        sort_into_blocks(all);
        CurvePath path = path_of(model_, 0);
        if (path.contours().empty()) {
            fail(0, "has no outline" + (skipped_.empty() ? "" : ", only " + skipped_.text()));
        }
        if (unit != LengthUnit::user) {
            const double scale = pixels_ / pixels_per(unit);
            if (scale == 0.0) {
                fail(0, "states no unit ($INSUNITS 1 to 14); --units needs one");
            }
            path.transform({{scale, 0.0}, {0.0, scale}, {}});
        }
        return path;
    }

private:
    /// A number of copies, at least 1; of those that are too many, as many as are refused.
    [[nodiscard]] std::size_t count(const DxfEntity& entity, int code) const {
        const double most = static_cast<double>(most_segments) + 1.0;
        return static_cast<std::size_t>(std::clamp(number(entity, code, 1.0), 1.0, most));
    }

    void sort_into_blocks(const std::vector<DxfEntity>& all) {
        std::string_view section;
        DxfBlock* block = nullptr;
        for (const DxfEntity& entity : all) {
            if (entity.type == "SECTION") {
                section = entity.text(2);
                block = section == "ENTITIES" ? &model_ : nullptr;
                if (section == "HEADER") {
                    read_unit(entity);
                }
            } else if (entity.type == "ENDSEC") {
                section = {};
                block = nullptr;
            } else if (section == "TABLES" && entity.type == "LAYER") {
                read_layer(entity);
            } else if (section == "BLOCKS" && entity.type == "BLOCK") {
                block = &blocks_[entity.name(2)];
                *block = {.base = point(entity, 10)};
            } else if (section == "BLOCKS" && entity.type == "ENDBLK") {
                block = nullptr;
            } else if (block != nullptr) {
                block->entities.push_back(entity);
            }
        }
        if (!section.empty()) {
            fail(all.back().offset,
                 "the file ends within its section " + std::string(section.substr(0, 40)));
        }
    }

    void read_unit(const DxfEntity& header) {
        for (std::size_t i = 0; i + 1 < header.groups.size(); ++i) {
            if (header.groups[i].code == 9 && header.groups[i].value == "$INSUNITS") {
                pixels_ = pixels_of_insunits(number(header.groups[i + 1]));
            }
        }
    }

    void read_layer(const DxfEntity& layer) {
        if (number(layer, 62, 7.0) < 0.0 || has_flag(layer, 70, 1)) {
            hidden_layers_.insert(layer.name(2));
        }
    }

    /// The outlines of a block, for which no block may be needed that needs it.
    const CurvePath& path_of(DxfBlock& block, std::size_t offset) {
        if (block.state == DxfBlock::State::in_progress) {
            fail(offset, "INSERT: the block holds itself");
        }
        if (block.state == DxfBlock::State::unread) {
            block.state = DxfBlock::State::in_progress;
            std::vector<ArcChain> chains;
            for (std::size_t i = 0; i < block.entities.size(); ++i) {
                read_entity(block, i, chains);
            }
            close(chains);
            for (const ArcChain& chain : chains) {
                block.segments += chain.points.size();
                append_chain(chain, block.path);
            }
            block.state = DxfBlock::State::done;
        }
        return block.path;
    }

    void close(std::vector<ArcChain>& chains) {
        const double gap = 1e-6 * extent_of(chains);
        std::optional<LooseEnd> end = close_chains(chains, gap);
        if (const std::size_t repeated = end ? remove_repeated(chains) : 0; repeated > 0) {
            skipped_.add("line drawn twice", repeated);
            end = close_chains(chains, gap);
        }
        if (end) {
            char text[120];
            std::snprintf(text, sizeof text,
                          "the outline is open: nothing continues it at (%.17g, %.17g)", end->at.x,
                          end->at.y);
            fail(end->offset, text);
        }
    }

    void read_entity(DxfBlock& block, std::size_t& index, std::vector<ArcChain>& chains) {
        const DxfEntity& entity = block.entities[index];
        const std::string_view type = entity.type;
        if (has_flag(entity, 67, 1) || has_flag(entity, 60, 1)) {
            return skip(block, index, "of paper space, or invisible");
        }
        if (hidden_layers_.contains(entity.name(8))) {
            return skip(block, index, "on a layer that is off or frozen");
        }
        if (is_dxf_annotation(type)) {
            skipped_.add(type);
        } else if (type == "LWPOLYLINE") {
            add(lightweight(entity), chains);
        } else if (type == "POLYLINE") {
            add(polyline(block, index), chains);
        } else if (type == "LINE") {
            if (number(entity, 30, 0.0) != number(entity, 31, 0.0)) {
                fail(entity, "does not lie in the plane of x and y");
            }
            add({.points = {{point(entity, 10), 0.0}, {point(entity, 11), 0.0}},
                 .offset = entity.offset},
                chains);
        } else if ((type == "ARC" || type == "CIRCLE") && radius(entity) == 0.0) {
            skipped_.add(empty_part);
        } else if (type == "ARC") {
            add_arc(block, entity, chains);
        } else if (type == "CIRCLE") {
            add_circle(block, entity);
        } else if (type == "ELLIPSE") {
            add_ellipse(block, entity, chains);
        } else if (type == "SPLINE") {
            add(dxf_spline(*this, entity), chains);
        } else if (type == "INSERT") {
            insert(block, entity);
        } else {
            fail(entity, "is not read; convert it to polylines, or remove it");
        }
    }

    /// Passes an entity, with the vertices that follow it.
    void skip(const DxfBlock& block, std::size_t& index, std::string_view why) {
        skipped_.add(why);
        const auto next_is = [&](std::string_view type) {
            return index + 1 < block.entities.size() && block.entities[index + 1].type == type;
        };
        while (next_is("VERTEX") || next_is("SEQEND")) {
            ++index;
        }
    }

    /// Adds a chain that goes somewhere.
    void add(ArcChain chain, std::vector<ArcChain>& chains) {
        if (chain.points.size() >= 2) {
            return chains.push_back(std::move(chain));
        }
        skipped_.add(empty_part);
    }

    void add_circle(DxfBlock& block, const DxfEntity& entity) const {
        block.path.circle(placed(entity, point(entity, 10)), radius(entity));
        ++block.segments;
    }

    [[nodiscard]] Vector2 placed(const DxfEntity& entity, const Vector2& point) const {
        return {direction(entity) * point.x, point.y};
    }

    [[nodiscard]] ArcChain lightweight(const DxfEntity& entity) const {
        ArcChain chain{.points = {}, .closed = has_flag(entity, 70, 1), .offset = entity.offset};
        const double way = direction(entity);
        for (const DxfGroup& group : entity.groups) {
            if (group.code == 10) {
                chain.points.push_back({{way * number(group), 0.0}, 0.0});
            } else if (!chain.points.empty() && group.code == 20) {
                chain.points.back().at.y = number(group);
            } else if (!chain.points.empty() && group.code == 42) {
                chain.points.back().bulge = way * number(group);
            }
        }
        return chain;
    }

    /// A POLYLINE and the VERTEX entities that follow it, which `index` then has passed.
    [[nodiscard]] ArcChain polyline(const DxfBlock& block, std::size_t& index) const {
        const DxfEntity& entity = block.entities[index];
        constexpr int in_space_or_mesh = 8 | 16 | 64;
        constexpr int frame_of_spline = 16;
        if (has_flag(entity, 70, in_space_or_mesh)) {
            fail(entity, "is a mesh, or lies in space");
        }
        ArcChain chain{.points = {}, .closed = has_flag(entity, 70, 1), .offset = entity.offset};
        const double way = direction(entity);
        while (index + 1 < block.entities.size() && block.entities[index + 1].type == "VERTEX") {
            const DxfEntity& vertex = block.entities[++index];
            if (!has_flag(vertex, 70, frame_of_spline)) {
                const Vector2 at = point(vertex, 10);
                chain.points.push_back({{way * at.x, at.y}, way * number(vertex, 42, 0.0)});
            }
        }
        if (index + 1 < block.entities.size() && block.entities[index + 1].type == "SEQEND") {
            ++index;
        }
        return chain;
    }

    void add_arc(DxfBlock& block, const DxfEntity& entity, std::vector<ArcChain>& chains) const {
        constexpr double degree = std::numbers::pi / 180.0;
        const Vector2 centre = point(entity, 10);
        const double first = std::fmod(number(entity, 50), 360.0);
        double sweep = std::fmod(number(entity, 51) - first, 360.0);
        sweep += sweep <= 0.0 ? 360.0 : 0.0;
        if (sweep == 360.0) {
            return add_circle(block, entity);
        }
        const double way = direction(entity);
        const auto at = [&](double degrees) {
            const auto [sine, cosine] = sine_cosine(degree * degrees);
            return Vector2{way * (centre.x + radius(entity) * cosine),
                           centre.y + radius(entity) * sine};
        };
        const auto [sine, cosine] = sine_cosine(0.25 * degree * sweep);
        chains.push_back({.points = {{at(first), way * (sine / cosine)}, {at(first + sweep), 0.0}},
                          .offset = entity.offset});
    }

    void add_ellipse(DxfBlock& block, const DxfEntity& entity,
                     std::vector<ArcChain>& chains) const {
        const DxfEllipse ellipse = dxf_ellipse(*this, entity);
        if (ellipse.arc) {
            chains.push_back(*ellipse.arc);
            return;
        }
        block.path.ellipse(ellipse.centre, ellipse.length, ellipse.width, ellipse.rotation);
        ++block.segments;
    }

    void insert(DxfBlock& block, const DxfEntity& entity) {
        const auto found = blocks_.find(entity.name(2));
        if (found == blocks_.end()) {
            fail(entity, "there is no block \"" + std::string(entity.text(2).substr(0, 40)) + "\"");
        }
        const CurvePath& content = path_of(found->second, entity.offset);
        const std::size_t columns = count(entity, 70);
        const std::size_t copies = columns * count(entity, 71);
        block.segments += copies * std::max<std::size_t>(found->second.segments, 1);
        if (block.segments > most_segments) {
            fail(entity,
                 "the blocks place more than " + std::to_string(most_segments) + " segments");
        }
        const Vector2 scale{number(entity, 41, 1.0), number(entity, 42, 1.0)};
        const Vector2& base = found->second.base;
        const Vector2 at = point(entity, 10);
        const double way = direction(entity);
        const auto [sine, cosine] = sine_cosine(std::numbers::pi / 180.0 * number(entity, 50, 0.0));
        AffineMap map{{way * scale.x * cosine, scale.x * sine},
                      {-way * scale.y * sine, scale.y * cosine},
                      {}};
        const Vector2 first{way * at.x - base.x * map.x_axis.x - base.y * map.y_axis.x,
                            at.y - base.x * map.x_axis.y - base.y * map.y_axis.y};
        const double between_columns = number(entity, 44, 0.0);
        const double between_rows = number(entity, 45, 0.0);
        for (std::size_t i = 0; i < copies; ++i) {
            const std::size_t row = i / columns;
            const double right = static_cast<double>(i % columns) * between_columns;
            const double up = static_cast<double>(row) * between_rows;
            map.origin = {first.x + way * (right * cosine - up * sine),
                          first.y + right * sine + up * cosine};
            block.path.append(CurvePath(content).transform(map));
        }
    }

    SkippedParts& skipped_;
    std::map<std::string, DxfBlock> blocks_;
    std::set<std::string> hidden_layers_;  ///< off or frozen
    DxfBlock model_;
    double pixels_ = 0.0;  ///< in a unit of the file; 0 if it states none
};

}  // namespace

CurvePath parse_dxf(const std::string& text, const std::string& file, SkippedParts& skipped,
                    LengthUnit unit) {
    return DxfReader(text, file, skipped).read(unit);
}

}  // namespace nearfield::tools
