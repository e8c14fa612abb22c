#include <tools/io/input_error.hpp>
#include <tools/io/layout.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/svg.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace nearfield::tools {
namespace {

/// The longer side of the box of points on the outline.
double longer_side(const Outline& outline) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    Vector2 low{infinite, infinite};
    Vector2 high{-infinite, -infinite};
    for (const Ring& ring : tessellate_outline(outline, largest_coordinate).rings) {
        for (const Vector2& vertex : ring) {
            low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y)};
            high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y)};
        }
    }
    return std::max(high.x - low.x, high.y - low.y);
}

class LayoutReader {
public:
    explicit LayoutReader(const LayoutRequest& request) : request_(request) {}

    Scene read(std::vector<InputFile> files) {
        for (InputFile& file : files) {
            scene_.files.push_back(file.name);
            if (format_of(file) == OutlineFormat::svg) {
                add_svg(std::move(file));
            } else {
                add_outline(std::move(file));
            }
        }
        for (const QueryRequest& query : request_.queries) {
            add_query(query);
        }
        return std::move(scene_);
    }

private:
    void add_svg(InputFile file) {
        const std::string text = to_text(std::move(file.bytes), file.name);
        Outline whole{.file = file.name};
        SvgLayout layout = parse_svg_layout(text, file.name, whole.skipped, request_.unit);
        const std::size_t first = scene_.shapes.size();
        for (std::size_t i = 0; i < layout.shapes.size(); ++i) {
            Outline outline{.file = file.name + ": " + layout.shape_names[i],
                            .path = std::move(layout.shapes[i].path),
                            .parts = std::move(layout.shapes[i].parts)};
            add_shape(layout.shape_names[i], outline);
        }
        if (!whole.skipped.empty()) {
            whole.parts.emplace_back();
            std::string& note = scene_.shapes[first].note;
            note = skipped_note(whole) + (note.empty() ? "" : "; " + note);
        }
        for (SvgItem& item : layout.items) {
            add_instance(item.name, first + item.shape, item.pose);
        }
    }

    void add_outline(InputFile file) {
        const std::string name = std::filesystem::path(file.name).stem().string();
        const Outline outline = parse_outline(std::move(file), request_.unit);
        add_shape(name, outline);
        if (!outline.skipped.empty()) {
            std::string& note = scene_.shapes.back().note;
            note = skipped_note(outline) + (note.empty() ? "" : "; " + note);
        }
        add_instance(name, scene_.shapes.size() - 1, {});
    }

    void add_shape(const std::string& name, const Outline& outline) {
        SceneShape shape{.name = name};
        try {
            ShapeRings rings = make_shape_rings(outline, deviation_of(outline), request_.treatment);
            shape.rings = std::move(rings.rings);
            shape.deviation = rings.deviation;
            shape.note = std::move(rings.note);
        } catch (const InputError& error) {
            shape.problem = error.what();
        }
        scene_.shapes.push_back(std::move(shape));
    }

    [[nodiscard]] double deviation_of(const Outline& outline) const {
        if (!needs_deviation(outline, request_.treatment)) {
            return 0.0;
        }
        if (request_.deviation) {
            return *request_.deviation;
        }
        double tolerance = 0.0;
        for (const QueryRequest& query : request_.queries) {
            tolerance = std::max(tolerance, query.tolerance);
        }
        return tolerance > 0.0 ? usual_deviation * tolerance
                               : layout_deviation * longer_side(outline);
    }

    void add_instance(const std::string& name, std::size_t shape, const Pose& pose) {
        std::string unique = name;
        for (int& count = counts_[name]; !taken_.emplace(unique, true).second;) {
            unique = name + "#" + std::to_string(++count + 1);
        }
        scene_.instances.push_back({.name = std::move(unique), .shape = shape, .pose = pose});
    }

    void add_query(const QueryRequest& request) {
        SceneQuery query{.request = request, .all_pairs = true};
        query.kind = std::string(name_of(request.type));
        query.hits_only = request_.hits_only;
        // Of the items of a layout all pairs are meant, however far apart.
        query.reach = request.type == QueryType::separation ? largest_coordinate : 0.0;
        scene_.queries.push_back(std::move(query));
    }

    const LayoutRequest& request_;
    Scene scene_;
    std::map<std::string, int> counts_;
    std::map<std::string, bool> taken_;
};

}  // namespace

Scene read_layout(std::vector<InputFile> files, const LayoutRequest& request) {
    for (const QueryRequest& query : request.queries) {
        const std::string kind(name_of(query.type));
        if (query.type == QueryType::distance_field || query.type == QueryType::time_of_impact) {
            throw InputError("--query: " + kind + " is not asked of all pairs of outlines");
        }
        if (query.tolerance == 0.0 && !is_exact(query.type)) {
            throw InputError("-d: required for " + kind);
        }
    }
    return LayoutReader(request).read(std::move(files));
}

}  // namespace nearfield::tools
