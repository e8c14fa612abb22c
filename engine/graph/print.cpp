#include <engine/graph/access.hpp>
#include <engine/graph/names.hpp>
#include <engine/graph/print.hpp>

#include <algorithm>

namespace nearfield::graph {

namespace {

using std::string;
using std::to_string;

string to_text(const Graph& graph, const Barrier& barrier) {
    const Resource& resource = graph.resources()[barrier.resource];
    string text = "barrier " + resource.name() + ": " + stage_names(barrier.source_stages) + " (" +
                  access_names(barrier.source_access) + ") -> " +
                  stage_names(barrier.destination_stages) + " (" +
                  access_names(barrier.destination_access) + ")";
    if (resource.is_image) {
        text += ", layout " + layout_name(barrier.old_layout) + " -> " +
                layout_name(barrier.new_layout) +
                (barrier.takes_over_memory ? ", taking over memory" : "");
    }
    return text;
}

string to_text(const Graph& graph, const Attachment& attachment) {
    return "attachment " + graph.resources()[attachment.resource].name() + ": " +
           traits(attachment.access).name + ", " + (attachment.load ? "load" : "no load") + ", " +
           (attachment.store ? "store" : "no store");
}

string to_text(const Graph& graph, const Use& use) {
    const string version = to_string(use.handle.version);
    string text = use.write ? "write " : "read ";
    text += graph.resources()[use.handle.resource].name() + " " + version;
    if (use.write) {
        text += " -> " + to_string(use.handle.version + 1);
    }
    return text + " as " + traits(use.access).name;
}

string pass_text(const Graph& graph, const BakedPass& baked, std::size_t position) {
    const Pass& pass = graph.passes()[baked.pass];
    const bool graphics = pass.kind == PassKind::graphics;
    string text = to_string(position) + ". " + pass.name + (graphics ? " (graphics" : " (compute");
    text += graphics ? ", " + extent_text(baked.extent) + ")\n" : ")\n";
    for (const Barrier& barrier : baked.barriers) {
        text += "     " + to_text(graph, barrier) + "\n";
    }
    for (const Use& use : pass.uses) {
        text += "     " + to_text(graph, use) + "\n";
    }
    for (const Attachment& attachment : baked.attachments) {
        text += "     " + to_text(graph, attachment) + "\n";
    }
    return text;
}

string resource_text(const Resource& resource, const Lifetime& lifetime) {
    string text = (resource.is_image ? "image " : "buffer ") + resource.name() + ": ";
    if (resource.is_image) {
        text += format_name(resource.image.format) + ", " +
                (resource.imported ? "the caller's" : extent_text(resource.image.extent)) + ", ";
    }
    if (resource.outside.before) {
        text += std::string("before: ") + traits(*resource.outside.before).name + ", ";
    }
    if (resource.outside.after) {
        text += std::string("after: ") + traits(*resource.outside.after).name + ", ";
    }
    if (resource.buffer.written_by_host) {
        text += "written by the host, ";
    }
    if (resource.buffer.read_by_host) {
        text += "read by the host, ";
    }
    if (!lifetime.used) {
        return text + "unused";
    }
    text += "passes " + to_string(lifetime.first) + " to " + to_string(lifetime.last);
    if (resource.is_image && !resource.imported) {
        text += ", memory slot " + to_string(lifetime.memory_slot) + ", usage " +
                usage_names(lifetime.usage);
    }
    return text;
}

/// A text as a quoted identifier of the DOT language.
string dot_string(const string& text) {
    string result = "\"";
    for (const char character : text) {
        if (character == '"' || character == '\\') {
            result += '\\';
        }
        if (character == '\n') {
            result += "\\n";
        } else {
            result += character;
        }
    }
    return result + '"';
}

string version_node(Handle handle) {
    return "resource_" + to_string(handle.resource) + "_" + to_string(handle.version);
}

std::vector<std::uint32_t> newest_versions(const Graph& graph) {
    std::vector<std::uint32_t> newest(graph.resources().size());
    for (const Pass& pass : graph.passes()) {
        for (const Use& use : pass.uses) {
            std::uint32_t& version = newest[use.handle.resource];
            version = std::max(version, use.handle.version + (use.write ? 1 : 0));
        }
    }
    return newest;
}

/// The ellipses of a resource; a version without content is dotted.
string version_nodes(const Graph& graph, std::uint32_t index, std::uint32_t newest) {
    const Resource& resource = graph.resources()[index];
    string text;
    for (std::uint32_t version = 0; version <= newest; ++version) {
        const bool empty = version == 0 && !resource.has_content();
        text += "    " + version_node({index, version}) + " [shape=ellipse" +
                (empty ? ", style=dotted" : "") +
                ", label=" + dot_string(resource.name() + "\nversion " + to_string(version)) +
                "];\n";
    }
    return text;
}

/// The arrows between a pass and the versions it reads and writes.
string use_arrows(const Pass& pass, const string& node) {
    string text;
    for (const Use& use : pass.uses) {
        const string label = " [label=" + dot_string(traits(use.access).name) + "];\n";
        text += "    " + version_node(use.handle) + " -> " + node + label;
        if (use.write) {
            const Handle written = {use.handle.resource, use.handle.version + 1};
            text += "    " + node + " -> " + version_node(written) + label;
        }
    }
    return text;
}

}  // namespace

string print_text(const Graph& graph, const BakedGraph& baked) {
    string text = "passes\n";
    for (std::size_t position = 0; position < baked.passes.size(); ++position) {
        text += pass_text(graph, baked.passes[position], position);
    }
    if (!baked.to_host.empty()) {
        text += "to the host\n";
    }
    for (const Barrier& barrier : baked.to_host) {
        text += "     " + to_text(graph, barrier) + "\n";
    }
    text += "resources, " + to_string(baked.memory_slots) + " memory slots\n";
    for (std::size_t i = 0; i < graph.resources().size(); ++i) {
        text += "     " + resource_text(graph.resources()[i], baked.lifetimes[i]) + "\n";
    }
    return text;
}

string print_graphviz(const Graph& graph, const BakedGraph& baked, const string& name) {
    string text = "digraph " + dot_string(name) + " {\n    rankdir=LR;\n";
    const std::vector<std::uint32_t> newest = newest_versions(graph);
    for (std::uint32_t i = 0; i < newest.size(); ++i) {
        text += version_nodes(graph, i, newest[i]);
    }
    for (std::size_t position = 0; position < baked.passes.size(); ++position) {
        const BakedPass& pass = baked.passes[position];
        const Pass& declared = graph.passes()[pass.pass];
        string label = to_string(position) + ". " + declared.name;
        for (const Barrier& barrier : pass.barriers) {
            label += '\n';
            label += to_text(graph, barrier);
        }
        const string node = "pass_" + to_string(position);
        text += "    " + node + " [shape=box, label=" + dot_string(label) + "];\n";
        text += use_arrows(declared, node);
    }
    return text + "}\n";
}

string print(const Graph& graph, const BakedGraph& baked, GraphFormat format, const string& title) {
    return format == GraphFormat::text ? title + ": " + print_text(graph, baked)
                                       : print_graphviz(graph, baked, title);
}

}  // namespace nearfield::graph
