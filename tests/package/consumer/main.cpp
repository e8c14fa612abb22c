// A host that uses only the installed files of nearfield. It uses every compiled part of the
// interface, and receives an error, which must not need exceptions or RTTI here.
#include <nearfield/vulkan.hpp>

#include <cmath>
#include <cstdio>
#include <cstring>

namespace {

bool failed(const nearfield::Status& status) {
    if (!status.ok()) {
        std::printf("%s\n", status.text().c_str());
    }
    return !status.ok();
}

bool wrong(bool is_right, const char* what) {
    if (!is_right) {
        std::printf("wrong: %s\n", what);
    }
    return !is_right;
}

// Two vertices of a square of side 2 are one unit deep in a larger square.
bool penetration_is_wrong(nearfield::Context& context) {
    const nearfield::Ring small{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    const nearfield::Ring large{{1, -3}, {9, -3}, {9, 5}, {1, 5}};
    const auto a = context.add_shape({&small, 1});
    const auto b = context.add_shape({&large, 1});
    if (failed(a.error()) || failed(b.error())) {
        return true;
    }
    nearfield::Batch batch;
    nearfield::PenetrationQuery query{};
    query.a.shape = *a;
    query.b.shape = *b;
    query.tolerance = 0.1;
    query.points = nearfield::PenetrationPoints::vertices;
    const auto good = batch.add(query);
    query.technique = nearfield::Technique::compute;
    const auto on_the_device = batch.add(query);
    query.tolerance = -1;
    const auto bad = batch.add(query);

    nearfield::Results results;
    const auto ticket = context.submit(batch);
    if (failed(ticket.error()) || failed(context.collect(*ticket, results))) {
        return true;
    }
    for (const auto handle : {good, on_the_device}) {
        const nearfield::PenetrationResult& result = results[handle];
        if (failed(result.status) || wrong(result.count == 2, "how many vertices are inside") ||
            wrong(std::abs(result.deepest.depth - 1) < 1e-9, "how deep they are") ||
            wrong(result.deepest.direction == nearfield::Vector2{-1, 0}, "the way out")) {
            return true;
        }
    }
    return wrong(results[bad].status.code() == nearfield::StatusCode::invalid_query,
                 "what is said of a bad tolerance") ||
           failed(context.update_shape(*a, {&large, 1})) || failed(context.remove_shape(*a));
}

bool curves_are_wrong() {
    nearfield::CurvePath path;
    path.move_to({0, 0}).cubic_to({1, 1}, {2, 1}, {3, 0}).close().circle({5, 5}, 1);
    const auto rings = nearfield::tessellate(path, 0.01);
    return failed(rings.error()) || wrong(rings->size() == 2, "how many rings there are");
}

bool fills_are_wrong() {
    const nearfield::Ring squares[] = {{{0, 0}, {2, 0}, {2, 2}, {0, 2}},
                                       {{1, 1}, {3, 1}, {3, 3}, {1, 3}},
                                       {{0, 0}, {1, 1}, {2, 2}}};
    const auto fill = nearfield::resolve_fill(squares, nearfield::FillRule::nonzero);
    const auto cleaned = nearfield::clean(squares);
    return failed(fill.error()) || failed(cleaned.error()) ||
           wrong(fill->rings.size() == 1, "how many rings a union has") ||
           wrong(cleaned->dropped.size() == 1, "how many rings enclose nothing");
}

}  // namespace

int main() {
    const nearfield::Version version = nearfield::version();
    if (wrong(std::strcmp(version.text, NEARFIELD_VERSION) == 0, "the library's version") ||
        wrong(version.abi == NEARFIELD_ABI_VERSION, "the library's ABI version") ||
        curves_are_wrong() || fills_are_wrong()) {
        return 1;
    }
    const auto devices = nearfield::list_devices();
    auto context = nearfield::Context::create_headless();
    if (failed(devices.error()) || failed(context.error()) || penetration_is_wrong(*context)) {
        return 1;
    }
    std::printf("nearfield %s, %s\n", version.text, context->device_name().c_str());
    return 0;
}
