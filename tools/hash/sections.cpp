#include <tools/common/library_error.hpp>
#include <tools/hash/sections.hpp>
#include <tools/simulation/scenes.hpp>

#include <iomanip>
#include <vector>

namespace nearfield::hash {
namespace {

constexpr std::uint32_t quick_pairs = 1'000;
constexpr std::uint32_t all_pairs = 100'000;

std::vector<Section> make_sections() {
    std::vector<Section> all{
        {"pairs", [](const MakeContext& make) { return hash_pairs(make, 0, quick_pairs); }},
        {"outlines", hash_outlines},
        {"world", hash_world},
        {"more_pairs",
         [](const MakeContext& make) {
             return hash_pairs(make, quick_pairs, all_pairs - quick_pairs);
         },
         false}};
    const auto scenes = simulation::paper_scenes();
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        all.push_back({scenes[i].name,
                       [i](const MakeContext& make) { return hash_simulation(make, i); }, false});
    }
    return all;
}

}  // namespace

std::span<const Section> sections() {
    static const std::vector<Section> all = make_sections();
    return all;
}

void print_hashes(const MakeContext& make_context, bool quick, std::ostream& stream) {
    for (const Section& section : sections()) {
        if (section.quick || !quick) {
            stream << std::left << std::setfill(' ') << std::setw(12) << section.name << std::right
                   << std::hex << std::setfill('0') << std::setw(16) << section.hash(make_context)
                   << std::dec << std::endl;
        }
    }
}

Context cpu_context(const Settings& settings) {
    return tools::take(Context::create_cpu(settings));
}

}  // namespace nearfield::hash
