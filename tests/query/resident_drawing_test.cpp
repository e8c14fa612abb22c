#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>
#include <tests/query/resident_view.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace nearfield::test {
namespace {

using ResidentDrawing = QueryTest;

constexpr std::uint64_t resident_drawing_seed = 8200;
constexpr VkExtent2D pixels{720, 540};

struct Scene {
    PlacedPair pair;
    ResidentView::Shot shot;

    [[nodiscard]] Vector2 place_of(std::uint32_t column, std::uint32_t row) const {
        return {shot.low.x + shot.step * (column + 0.5),
                shot.low.y + shot.step * (pixels.height - (row + 0.5))};
    }
    [[nodiscard]] const std::array<std::uint8_t, 4>& pixel_at(const Picture& picture,
                                                              const Vector2& place) const {
        const double column = (place.x - shot.low.x) / shot.step;
        const double row = picture.height - (place.y - shot.low.y) / shot.step;
        EXPECT_TRUE(column >= 0.0 && row >= 0.0 && column < picture.width && row < picture.height);
        return picture.at(std::min(static_cast<std::uint32_t>(column), picture.width - 1),
                          std::min(static_cast<std::uint32_t>(row), picture.height - 1));
    }
};

enum class Shown { inside, outside, arrow_inside, arrow_outside, sample, dark };

Shown shown(const std::array<std::uint8_t, 4>& pixel) {
    const auto [red, green, blue, alpha] = pixel;
    if (red == 0 && green == 102 && blue == 0) {
        return Shown::arrow_inside;
    }
    if (red == 102 && green == 0 && blue == 102) {
        return Shown::arrow_outside;
    }
    if (red == 255 && green == 255 && blue == 255) {
        return Shown::sample;
    }
    if (red < 60) {
        return Shown::dark;
    }
    return red > blue ? Shown::inside : Shown::outside;
}

bool is_arrow(Shown what) {
    return what == Shown::arrow_inside || what == Shown::arrow_outside;
}

/// Where there is neither an arrow nor a dot, the picture must show the side given by the oracle.
void check_sides(const Scene& scene, const Picture& picture, const ContactResult& contacts) {
    std::size_t checked = 0;
    for (std::uint32_t row = 3; row < picture.height; row += 7) {
        for (std::uint32_t column = 3; column < picture.width; column += 7) {
            const Vector2 place = scene.place_of(column, row);
            const double distance = scene.pair.b().signed_distance(place);
            const Shown what = shown(picture.at(column, row));
            const bool near_a_contact = std::any_of(
                contacts.points.begin(), contacts.points.end(), [&](const ContactPoint& record) {
                    return std::hypot(record.position.x - place.x, record.position.y - place.y) <
                           1.1 * scene.shot.arrow_length;
                });
            ASSERT_TRUE(near_a_contact || !is_arrow(what)) << column << ", " << row;
            if (!is_arrow(what) && what != Shown::sample &&
                std::abs(distance) > scene.pair.tolerance()) {
                ASSERT_EQ(what, distance < 0.0 ? Shown::inside : Shown::outside)
                    << column << ", " << row << ": distance " << distance;
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 5000U);
}

/// The middle of the shaft of the arrow of every contact of A is drawn.
void check_arrows(const Scene& scene, const Picture& picture, const ContactResult& contacts) {
    ASSERT_GT(contacts.points.size(), 20U);
    for (const ContactPoint& record : contacts.points) {
        if (record.on == Side::b) {
            continue;  // drawn along another direction
        }
        const double along = 0.4 * scene.shot.arrow_length;
        const Vector2 place{record.position.x + along * record.normal.x,
                            record.position.y + along * record.normal.y};
        EXPECT_TRUE(is_arrow(shown(scene.pixel_at(picture, place))))
            << "no arrow at " << place.x << ", " << place.y;
    }
}

/// The middle of every sample's dot shows a dot, or an arrow over it; and dots cover no more area
/// than that number of dots does.
void check_samples_drawn(const Scene& scene, const Picture& picture,
                         const IntersectionResult& overlap) {
    ASSERT_GT(overlap.samples.size(), 200U);
    for (const IntersectionSample& sample : overlap.samples) {
        const Shown what = shown(scene.pixel_at(picture, sample.position));
        EXPECT_TRUE(what == Shown::sample || is_arrow(what))
            << "no dot at " << sample.position.x << ", " << sample.position.y;
    }
    const auto dots =
        std::count_if(picture.pixels.begin(), picture.pixels.end(),
                      [](const auto& pixel) { return shown(pixel) == Shown::sample; });
    const double side = 0.4 * overlap.cell / scene.shot.step + 1.0;
    EXPECT_LE(static_cast<double>(dots), static_cast<double>(overlap.count) * side * side);
}

TEST_F(ResidentDrawing, AHostDrawsFieldContactsAndOverlapWithoutAnyReadBack) {
    Random random(resident_drawing_seed);
    const Rings rings = with_holes(random, 2);
    const Pair shapes{{"turned", rings}, {"holes", rings}, {{0.03, 0.02}, 0.12}, {}, 0.006};
    ResidentView view(host_device(), pixels);
    Scene scene{{context(), shapes, Technique::compute},
                {{-1.45, -1.1}, 2.9 / pixels.width, 0.1, 0.1}};
    DistanceFieldQuery field;
    field.b = scene.pair.instance_b();
    field.tolerance = scene.pair.tolerance();
    field.technique = Technique::compute;
    field.rectangle = Rectangle{{-1.5, -1.15}, {1.5, 1.15}};
    field.values = false;
    field.on_device = true;
    ContactQuery contacts = scene.pair.contacts(0.04);
    contacts.tolerance = 0.04;
    contacts.on_device = true;
    IntersectionQuery overlap = scene.pair.intersection(IntersectionKind::volume_volume);
    overlap.tolerance = 0.03;
    overlap.on_device = true;

    Batch batch;
    const auto field_handle = batch.add(field);
    const auto contacts_handle = batch.add(contacts);
    const auto overlap_handle = batch.add(overlap);
    const Expected<Ticket> ticket = context().submit(batch);
    ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
    const Expected<FieldOnDevice> images = context().on_device(*ticket, field_handle);
    const Expected<PointsOnDevice> records = context().on_device(*ticket, contacts_handle);
    const Expected<SamplesOnDevice> samples = context().on_device(*ticket, overlap_handle);
    ASSERT_TRUE(images.has_value() && records.has_value() && samples.has_value());
    // Drawn before anything is collected: nothing has been read back to the CPU.
    const Picture picture = view.draw({*images, *records, *samples}, scene.shot);
    Results results;
    ASSERT_TRUE(context().collect(*ticket, results).ok());
    EXPECT_TRUE(results[field_handle].values.empty());

    check_sides(scene, picture, results[contacts_handle]);
    check_arrows(scene, picture, results[contacts_handle]);
    check_samples_drawn(scene, picture, results[overlap_handle]);
    if (const char* const folder = std::getenv("NEARFIELD_TEST_PICTURES")) {
        picture.write(std::string(folder) + "/resident_" + to_string(Technique::compute) + ".ppm");
    }
}

}  // namespace
}  // namespace nearfield::test
