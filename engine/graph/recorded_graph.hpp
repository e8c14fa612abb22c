#pragma once

#include <engine/graph/bound_resources.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/graph/execute.hpp>
#include <engine/graph/graph.hpp>
#include <engine/graph/print.hpp>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::graph {

/// A graph with the Vulkan objects that execute it.
class CompiledGraph : public Graph {
public:
    CompiledGraph() = default;
    CompiledGraph(const CompiledGraph&) = delete;
    CompiledGraph& operator=(const CompiledGraph&) = delete;

    /// Makes the Vulkan objects, once all passes are declared.
    void compile(const gpu::Device& device) {
        device_ = &device;
        plan_ = SetPlan(*this);
        executor_ = make_executor(device, *this);
    }

    /// The precondition of all that follows: compile().
    [[nodiscard]] Executor& executor() const { return *executor_; }

    /// Resources to execute it with.
    [[nodiscard]] BoundResources make_resources(const ComputeLayout& layout) const {
        return {*device_, layout, *this, plan_, *executor_};
    }

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return graph::print(*this, executor_->baked(), format, title);
    }

private:
    const gpu::Device* device_ = nullptr;
    SetPlan plan_;
    std::unique_ptr<Executor> executor_;
};

/// A graph with the functions that record its passes. All passes are recorded from one const
/// `Input` and from what is bound, arguments of each execution, so that nothing stays in a pass
/// from one execution to the next.
template <class Input>
class RecordedGraph : public CompiledGraph {
public:
    /// Records a pass's commands. The graph has already recorded the barriers, the start of the
    /// render pass (for a graphics pass), the label and the first timestamp.
    using Record = std::function<void(const PassCommands&, const Input&)>;

    /// Declares a pass (Graph::add_pass); `record` is called whenever the graph is executed.
    template <class Setup>
    void add_pass(std::string name, PassKind kind, Setup&& setup, Record record) {
        Graph::add_pass(std::move(name), kind, std::forward<Setup>(setup));
        records_.push_back(std::move(record));
    }

    /// Records all passes; see Executor::execute.
    void execute(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                 const BoundResources& resources, const Input& input) const {
        const auto record = [&](std::size_t pass, VkCommandBuffer into) {
            records_[pass](PassCommands(into, &resources, pass), input);
        };
        executor().execute(*this, resources.imported(), commands, timestamps, record);
    }

private:
    std::vector<Record> records_;  // by position of the pass
};

}  // namespace nearfield::graph
