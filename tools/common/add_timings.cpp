#include <tools/common/add_timings.hpp>

#include <algorithm>

namespace nearfield::tools {

void add_timings(const Timings& more, Timings& sum) {
    sum.localize += more.localize;
    sum.plan += more.plan;
    sum.record += more.record;
    sum.device += more.device;
    sum.decode += more.decode;
    sum.total += more.total;
    sum.queries.insert(sum.queries.end(), more.queries.begin(), more.queries.end());
    for (const PassTime& pass : more.passes) {
        const auto found =
            std::find_if(sum.passes.begin(), sum.passes.end(),
                         [&pass](const PassTime& other) { return other.name == pass.name; });
        if (found == sum.passes.end()) {
            sum.passes.push_back(pass);
        } else {
            found->milliseconds += pass.milliseconds;
        }
    }
}

}  // namespace nearfield::tools
