#include <tools/io/json_writer.hpp>
#include <tools/peers/report.hpp>

#include <algorithm>
#include <cstdio>
#include <set>
#include <string_view>

namespace nearfield::peers {
namespace {

using tools::JsonWriter;

std::string digits(double number) {
    char text[32];
    std::snprintf(text, sizeof text, number >= 1000.0 ? "%.0f" : "%.3g", number);
    return text;
}

/// The peer's time as a multiple of nearfield's; below 1, nearfield is slower.
std::string times_as_long(const std::optional<double>& peer, const benchmark::Spread& ours) {
    return peer ? digits(*peer / ours.median) : "";
}

constexpr const char* peer_names[] = {"GEOS", "Boost", "Boost R-tree", "CGAL", "Clipper", "OpenCV"};

void write_spread(JsonWriter& json, std::string_view name, const benchmark::Spread& spread) {
    json.key(name).begin_object();
    json.member("median", spread.median);
    json.member("min", spread.least);
    json.member("quartiles", std::array{spread.lower_quartile, spread.upper_quartile});
    json.member("frames", spread.count);
    json.end_object();
}

void write_quickest(JsonWriter& json, std::string_view name, const std::optional<double>& quickest,
                    const benchmark::Spread& ours) {
    json.member(name, quickest.value_or(0.0) / ours.median, quickest.has_value());
}

void write_peer(JsonWriter& json, const PeerTimes& peer) {
    json.begin_object(JsonWriter::Layout::lines);
    json.member("how", peer.how);
    json.member("exact", peer.exact);
    json.member("signed", peer.has_sign);
    write_spread(json, "built_ms", peer.built_ms);
    write_spread(json, "kept_ms", peer.kept_ms);
    if (peer.exact) {
        json.member("largest_difference", peer.largest_difference);
        json.member("allowed", peer.allowed);
    } else {
        json.member("error_in_cells", peer.error_in_cells);
    }
    json.end_object();
}

}  // namespace

void write_head(std::ostream& stream, const benchmark::Machine& machine,
                const std::string& device) {
    stream
        << machine.date << ", nearfield " << machine.commit << "; " << machine.processor
        << ", pinned to one core; " << device << "\n\n"
        << "Milliseconds, medians, built / kept: with all shapes passed, and geometries and "
           "indices "
           "made, each frame, and with all\n"
        << "of that made before and nothing moved. nearfield: a whole frame by automatic. The last "
           "columns: how many times as long\n"
        << "as nearfield the quickest peer takes that gives the whole answer exactly, built and "
           "kept; below 1 nearfield is behind.\n\n"
        << "| row | queries | nearfield | by";
    for (const char* const name : peer_names) {
        stream << " | " << name;
    }
    stream << " | built | kept |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n"
           << std::flush;
}

void write_row(std::ostream& stream, const ProblemTimes& times) {
    stream << "| " << times.name << " | " << times.queries << " | " << digits(times.built_ms.median)
           << " / " << digits(times.kept_ms.median) << " | " << times.technique;
    for (const std::string_view name : peer_names) {
        const auto peer = std::find_if(times.peers.begin(), times.peers.end(),
                                       [&](const PeerTimes& any) { return any.name == name; });
        stream << " | ";
        if (peer != times.peers.end()) {
            stream << digits(peer->built_ms.median) << " / " << digits(peer->kept_ms.median);
            if (!peer->has_sign) {
                stream << ", no sign";
            }
            if (!peer->exact) {
                stream << ", off by " << digits(peer->error_in_cells) << " cells";
            }
        }
    }
    stream << " | " << times_as_long(times.quickest(&PeerTimes::built_ms), times.built_ms) << " | "
           << times_as_long(times.quickest(&PeerTimes::kept_ms), times.kept_ms) << " |\n"
           << std::flush;
}

void write_notes(std::ostream& stream, std::span<const ProblemTimes> table) {
    std::set<std::string> notes;
    for (const ProblemTimes& times : table) {
        std::string task = times.name.substr(times.name.rfind(", ") + 2);
        task = task.rfind("field", 0) == 0 ? "field" : task;
        for (const PeerTimes& peer : times.peers) {
            notes.insert(peer.name + ", " + task + ": " + peer.how);
        }
    }
    stream << '\n';
    for (const std::string& note : notes) {
        stream << "- " << note << '\n';
    }
}

void write_worlds(std::ostream& stream, std::span<const WorldTimes> table) {
    stream << "\n| question | nearfield, ms | others: ms (times nearfield's) |\n|---|---|---|\n";
    for (const WorldTimes& times : table) {
        stream << "| " << times.name << " | " << digits(times.nearfield_ms.median) << " |";
        for (const WorldPeerTimes& peer : times.peers) {
            stream << ' ' << peer.name << ": " << digits(peer.ms.median) << " ("
                   << times_as_long(peer.ms.median, times.nearfield_ms) << ") " << peer.how;
            if (peer.apart > 0) {
                stream << "; " << peer.apart << " answers differ by more than its rounding";
            }
            stream << " |";
        }
        stream << '\n';
    }
}

void write_json(std::ostream& stream, std::span<const ProblemTimes> table,
                std::span<const WorldTimes> worlds, const benchmark::Machine& machine,
                const std::string& device) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.member("commit", machine.commit);
    json.member("date", machine.date);
    json.member("processor", machine.processor);
    json.member("device", device);
    json.list("rows", table, [&json](const ProblemTimes& times) {
        json.begin_object(JsonWriter::Layout::lines);
        json.member("name", times.name);
        json.member("queries", times.queries);
        json.member("technique", times.technique);
        write_spread(json, "nearfield_built_ms", times.built_ms);
        write_spread(json, "nearfield_kept_ms", times.kept_ms);
        json.key("peers").begin_object(JsonWriter::Layout::lines);
        for (const PeerTimes& peer : times.peers) {
            json.key(peer.name);
            write_peer(json, peer);
        }
        json.end_object();
        write_quickest(json, "quickest_built_to_nearfield", times.quickest(&PeerTimes::built_ms),
                       times.built_ms);
        write_quickest(json, "quickest_kept_to_nearfield", times.quickest(&PeerTimes::kept_ms),
                       times.kept_ms);
        json.end_object();
    });
    json.list("worlds", worlds, [&json](const WorldTimes& times) {
        json.begin_object(JsonWriter::Layout::lines);
        json.member("name", times.name);
        write_spread(json, "nearfield_ms", times.nearfield_ms);
        json.key("peers").begin_object(JsonWriter::Layout::lines);
        for (const WorldPeerTimes& peer : times.peers) {
            json.key(peer.name).begin_object();
            json.member("how", peer.how).member("apart", peer.apart);
            write_spread(json, "ms", peer.ms);
            json.end_object();
        }
        json.end_object().end_object();
    });
    json.end_object();
    stream << '\n';
}

}  // namespace nearfield::peers
