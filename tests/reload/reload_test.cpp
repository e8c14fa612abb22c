#include <nearfield/vulkan.hpp>

#include <gtest/gtest.h>
#include <tests/support/shader_folder.hpp>

#include <algorithm>
#include <optional>

namespace nearfield::test {
namespace {

using test_support::ShaderFolder;

/// A context that uses the shaders of a test folder, on any available device.
class ShaderReload : public ::testing::Test {
protected:
    ShaderReload() {
        HeadlessOptions options;
        options.log = {this, [](void* user, LogLevel level, const char* message) {
                           if (level == LogLevel::error) {
                               static_cast<ShaderReload*>(user)->errors_.emplace_back(message);
                           }
                       }};
        Expected<Context> context = Context::create_headless(options);
        if (!context) {
            throw std::runtime_error(context.error().text());
        }
        context_.emplace(std::move(*context));
        shape_ = *context_->add_shape({{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}});
    }

    /// The number of common samples of two squares that overlap by a quarter, by the compute
    /// technique: one shader draws the masks of both, another counts the intersection.
    std::uint64_t count() {
        Batch batch;
        const auto query = batch.add(IntersectionQuery{{shape_, {}},
                                                       {shape_, {{2.0, 2.0}, 0.0}},
                                                       0.1,
                                                       IntersectionKind::volume_volume,
                                                       true,
                                                       {},
                                                       Technique::compute});
        Results results;
        const Status status = context_->run(batch, results);
        EXPECT_TRUE(status.ok() && results[query].status.ok()) << status.text();
        return results[query].count;
    }
    /// Returns how many shaders changed.
    std::uint32_t reload() {
        const Expected<std::uint32_t> changed = reload_shaders(*context_, folder_.path().c_str());
        EXPECT_TRUE(changed.has_value()) << changed.error().text();
        return changed.has_value() ? *changed : UINT32_MAX;
    }

    ShaderFolder folder_;
    std::vector<std::string> errors_;
    std::optional<Context> context_;
    ShapeHandle shape_;
};

TEST_F(ShaderReload, ChangesWhatLaterBatchesAnswerAndBack) {
    const std::uint64_t count_as_built = count();
    EXPECT_GT(count_as_built, 100U);
    ASSERT_EQ(*reload_shaders(*context_), 0U) << "as the library was built";
    EXPECT_EQ(reload(), 0U) << "a copy of the same";
    EXPECT_EQ(count(), count_as_built);

    folder_.replace("collect_masks.comp", "if (count == 0u) {", "if (true) {");
    EXPECT_EQ(reload(), 1U);
    EXPECT_EQ(count(), 0U);
    EXPECT_EQ(reload(), 0U) << "it was taken up already";
    folder_.restore("collect_masks.comp");
    EXPECT_EQ(reload(), 1U);
    EXPECT_EQ(count(), count_as_built);

    // A file that several shaders include.
    folder_.replace("masks.glsl", "word ^= word >> 1;", "word ^= word >> 3;");
    EXPECT_GT(reload(), 1U);
    EXPECT_NE(count(), count_as_built);
    folder_.restore("masks.glsl");
    EXPECT_GT(reload(), 1U);
    EXPECT_EQ(count(), count_as_built);
    EXPECT_EQ(errors_, std::vector<std::string>{});
}

TEST_F(ShaderReload, OfWhatDoesNotCompileSaysWhyAndLeavesWhatIsInUse) {
    const std::uint64_t count_as_built = count();
    folder_.replace("collect_masks.comp", "if (count == 0u) {", "if (true) {");
    folder_.replace("field_rows.comp", "void main() {", "void main() {\n    nonsense;");
    const char* const folder = folder_.path().c_str();
    for (int attempt = 0; attempt < 2; ++attempt) {
        const Status status = reload_shaders(*context_, folder).error();
        EXPECT_EQ(status.code(), StatusCode::invalid_shader);
        EXPECT_NE(status.message().find("field_rows.comp' does not compile"), std::string::npos);
        const auto says = [](const std::string& line) {
            return line.find("nonsense") != std::string::npos;
        };
        EXPECT_TRUE(std::any_of(status.reasons().begin(), status.reasons().end(), says))
            << status.text();
        EXPECT_TRUE(std::any_of(errors_.begin(), errors_.end(), says));
        EXPECT_EQ(count(), count_as_built) << "though another shader did compile";
        errors_.clear();
    }
    folder_.restore("field_rows.comp");
    EXPECT_EQ(reload(), 1U);
    EXPECT_EQ(count(), 0U);

    const Status nowhere = reload_shaders(*context_, "/no/such/folder").error();
    EXPECT_EQ(nowhere.code(), StatusCode::invalid_shader);
    EXPECT_NE(nowhere.message().find("/no/such/folder"), std::string::npos) << nowhere.text();
}

}  // namespace
}  // namespace nearfield::test
