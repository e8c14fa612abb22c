#include <engine/graph/bake_steps.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace nearfield::graph {

namespace {

/// `before` has to run before `after` because of a version of a resource.
struct Edge {
    std::uint32_t before = 0;
    std::uint32_t after = 0;
    Handle handle;
    bool replaces = false;  ///< `after` replaces what `before` reads; else it needs its output
};

/// The pass that writes on top of each version.
using Writers = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;

class Ordering {
public:
    explicit Ordering(const Graph& graph) : graph_(graph), done_(graph.passes().size()) {}

    Expected<std::vector<std::uint32_t>> run() {
        if (Status status = find_writers(); !status.ok()) {
            return status;
        }
        if (Status status = find_edges(); !status.ok()) {
            return status;
        }
        std::vector<std::uint32_t> order;
        while (order.size() < done_.size()) {
            const std::uint32_t next = first_ready();
            if (next == done_.size()) {
                return knot();
            }
            done_[next] = true;
            order.push_back(next);
        }
        return order;
    }

private:
    [[nodiscard]] std::string pass_name(std::uint32_t pass) const {
        return "pass '" + graph_.passes()[pass].name + "'";
    }
    [[nodiscard]] std::string version_name(Handle handle) const {
        return "version " + std::to_string(handle.version) + " of '" +
               graph_.resources()[handle.resource].name() + "'";
    }

    Status find_writers() {
        for (std::uint32_t pass = 0; pass < graph_.passes().size(); ++pass) {
            for (const Use& use : graph_.passes()[pass].uses) {
                if (!use.write) {
                    continue;
                }
                const auto [entry, is_new] =
                    writers_.try_emplace({use.handle.resource, use.handle.version}, pass);
                if (!is_new) {
                    return graph_error(pass_name(entry->second) + " and " + pass_name(pass) +
                                       " both write on top of " + version_name(use.handle));
                }
            }
        }
        return {};
    }

    Status find_edges() {
        for (std::uint32_t pass = 0; pass < graph_.passes().size(); ++pass) {
            for (const Use& use : graph_.passes()[pass].uses) {
                const Handle handle = use.handle;
                if (handle.version > 0) {
                    const auto producer = writers_.find({handle.resource, handle.version - 1});
                    if (producer == writers_.end()) {
                        return nobody_wrote(pass, use);
                    }
                    edges_.push_back({producer->second, pass, handle, false});
                } else if (!use.write && !graph_.resources()[handle.resource].has_content()) {
                    return nobody_wrote(pass, use);
                }
                const auto successor = writers_.find({handle.resource, handle.version});
                if (!use.write && successor != writers_.end()) {
                    edges_.push_back({pass, successor->second, handle, true});
                }
            }
        }
        return {};
    }

    [[nodiscard]] Status nobody_wrote(std::uint32_t pass, const Use& use) const {
        return graph_error(pass_name(pass) + (use.write ? " writes on top of " : " reads ") +
                           version_name(use.handle) + ", which nobody wrote");
    }

    /// The first pass, in the order of declaration, that waits for nothing; the number of passes if
    /// all wait.
    [[nodiscard]] std::uint32_t first_ready() const {
        std::vector<bool> waits = done_;
        for (const Edge& edge : edges_) {
            if (!done_[edge.before]) {
                waits[edge.after] = true;
            }
        }
        return static_cast<std::uint32_t>(std::find(waits.begin(), waits.end(), false) -
                                          waits.begin());
    }

    /// All remaining passes wait, so following each to one that it waits for ends in a cycle.
    [[nodiscard]] std::vector<Edge> find_circle() const {
        std::vector<Edge> path;
        auto pass = static_cast<std::uint32_t>(std::find(done_.begin(), done_.end(), false) -
                                               done_.begin());
        while (true) {
            const auto visited = std::find_if(
                path.begin(), path.end(), [pass](const Edge& edge) { return edge.after == pass; });
            if (visited != path.end()) {
                path.erase(path.begin(), visited);
                std::reverse(path.begin(), path.end());
                return path;
            }
            const auto edge = std::find_if(edges_.begin(), edges_.end(), [&](const Edge& other) {
                return other.after == pass && !done_[other.before];
            });
            path.push_back(*edge);
            pass = edge->before;
        }
    }

    [[nodiscard]] Status knot() const {
        std::vector<Edge> circle = find_circle();
        const auto stale = std::find_if(circle.begin(), circle.end(),
                                        [](const Edge& edge) { return edge.replaces; });
        if (stale != circle.end()) {
            return graph_error(pass_name(stale->before) + " reads " + version_name(stale->handle) +
                               " through a stale handle: " + pass_name(stale->after) +
                               ", which replaces that version, has to run before it");
        }
        std::string text = "the passes wait for each other in a cycle";
        for (const Edge& edge : circle) {
            text += "; " + pass_name(edge.after) + " needs " + version_name(edge.handle) +
                    " from " + pass_name(edge.before);
        }
        return graph_error(text);
    }

    const Graph& graph_;
    std::vector<bool> done_;
    Writers writers_;
    std::vector<Edge> edges_;
};

}  // namespace

Expected<std::vector<std::uint32_t>> order_passes(const Graph& graph) {
    return Ordering(graph).run();
}

}  // namespace nearfield::graph
