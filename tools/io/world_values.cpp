#include <tools/io/npy.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/world_records.hpp>
#include <tools/io/world_values.hpp>

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace nearfield::tools {
namespace {

/// A row that collects the names of its cells.
class NamesRow {
public:
    explicit NamesRow(std::vector<std::string>& names) : names_(names) {}

    void number(std::string_view name, double /*number*/) { names_.emplace_back(name); }
    void truth(std::string_view name, bool /*truth*/) { names_.emplace_back(name); }
    void instance(std::string_view name, InstanceHandle /*handle*/) { names_.emplace_back(name); }
    void state(std::string_view name, ImpactState /*state*/) { names_.emplace_back(name); }
    void index(std::string_view name, std::uint32_t /*index*/, bool /*is_there*/) {
        names_.emplace_back(name);
    }
    void point(std::string_view name, Vector2 /*point*/, bool /*is_there*/) {
        names_.push_back(std::string(name) + "_x");
        names_.push_back(std::string(name) + "_y");
    }
    void feature(std::string_view /*name*/, Feature /*feature*/) {
        names_.insert(names_.end(), {"edge", "vertex"});
    }

private:
    std::vector<std::string>& names_;
};

/// A row of numbers.
class NumbersRow {
public:
    NumbersRow(const WorldAnswer& answer, std::vector<double>& numbers)
        : answer_(answer), numbers_(numbers) {}

    void number(std::string_view /*name*/, double number) { numbers_.push_back(number); }
    void truth(std::string_view /*name*/, bool truth) { numbers_.push_back(truth ? 1.0 : 0.0); }
    void instance(std::string_view /*name*/, InstanceHandle handle) {
        const std::size_t index = answer_.index_of(handle);
        numbers_.push_back(index == WorldAnswer::no_instance ? -1.0 : static_cast<double>(index));
    }
    void state(std::string_view /*name*/, ImpactState state) {
        numbers_.push_back(static_cast<double>(state));
    }
    void index(std::string_view /*name*/, std::uint32_t index, bool is_there) {
        numbers_.push_back(is_there ? index : -1.0);
    }
    void point(std::string_view /*name*/, Vector2 point, bool is_there) {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        numbers_.push_back(is_there ? point.x : none);
        numbers_.push_back(is_there ? point.y : none);
    }
    void feature(std::string_view /*name*/, Feature feature) {
        index({}, feature.index, feature.kind == Feature::Kind::edge);
        index({}, feature.index, feature.kind == Feature::Kind::vertex);
    }

private:
    const WorldAnswer& answer_;
    std::vector<double>& numbers_;
};

/// A line of CSV.
class CsvRow {
public:
    CsvRow(const WorldAnswer& answer, std::ostream& stream) : answer_(answer), stream_(stream) {}

    void end() {
        stream_.put('\n');
        is_first_ = true;
    }
    void number(std::string_view /*name*/, double number) {
        separate();
        char digits[32];
        const auto [end, error] = std::to_chars(std::begin(digits), std::end(digits), number);
        static_cast<void>(error);  // a double in its shortest form has at most 24 characters
        stream_.write(digits, end - digits);
    }
    void truth(std::string_view /*name*/, bool truth) {
        separate();
        stream_.put(truth ? '1' : '0');
    }
    void instance(std::string_view /*name*/, InstanceHandle handle) {
        separate();
        if (is_instance(handle)) {
            text(answer_.name_of(handle));
        }
    }
    void state(std::string_view /*name*/, ImpactState state) {
        separate();
        stream_ << name_of(state);
    }
    void index(std::string_view /*name*/, std::uint32_t index, bool is_there) {
        separate();
        if (is_there) {
            stream_ << index;
        }
    }
    void point(std::string_view /*name*/, Vector2 point, bool is_there) {
        if (is_there) {
            number({}, point.x);
            number({}, point.y);
        } else {
            separate();
            separate();
        }
    }
    void feature(std::string_view /*name*/, Feature feature) {
        index({}, feature.index, feature.kind == Feature::Kind::edge);
        index({}, feature.index, feature.kind == Feature::Kind::vertex);
    }
    /// A cell, in quotation marks where it needs them.
    void text(const std::string& text) {
        if (text.find_first_of(",\"\r\n") == std::string::npos) {
            stream_ << text;
            return;
        }
        stream_.put('"');
        for (const char character : text) {
            stream_ << (character == '"' ? "\"\"" : std::string(1, character));
        }
        stream_.put('"');
    }
    void separate() {
        if (!is_first_) {
            stream_.put(',');
        }
        is_first_ = false;
    }

private:
    const WorldAnswer& answer_;
    std::ostream& stream_;
    bool is_first_ = true;
};

/// Describes all records to a row, each with the number of its input where there are lists;
/// `end` is called after each.
template <class Row, class End>
void write_all_cells(const WorldAnswer& answer, Row& row, End end) {
    std::visit(
        [&](const auto& found) {
            const auto& records = records_of(found);
            if constexpr (has_lists<std::decay_t<decltype(found)>>) {
                for (std::uint32_t input = 0; input + 1 < found.offsets.size(); ++input) {
                    for (std::uint32_t i = found.offsets[input]; i < found.offsets[input + 1];
                         ++i) {
                        row.index("", input, true);
                        write_cells(row, records[i]);
                        end();
                    }
                }
            } else {
                for (const auto& record : records) {
                    write_cells(row, record);
                    end();
                }
            }
        },
        answer.records);
}

}  // namespace

std::string_view input_name(const WorldRequest& request) noexcept {
    switch (request.type) {
        case WorldQueryType::nearest:
            return request.shape ? "pose" : "point";
        case WorldQueryType::rays:
            return "segment";
        case WorldQueryType::cast:
            return "sweep";
        case WorldQueryType::overlap:
            if (!request.rectangles.empty()) {
                return "rectangle";
            }
            return request.shape ? "pose" : "point";
        case WorldQueryType::poses:
            break;
    }
    return "pose";
}

std::vector<std::string> world_columns(const WorldAnswer& answer) {
    std::vector<std::string> names;
    NamesRow row(names);
    std::visit(
        [&](const auto& found) {
            if (has_lists<std::decay_t<decltype(found)>>) {
                names.emplace_back(input_name(*answer.request));
            }
            write_cells(row, typename std::decay_t<decltype(records_of(found))>::value_type{});
        },
        answer.records);
    return names;
}

void write_world_csv(std::ostream& stream, const WorldAnswer& answer) {
    CsvRow row(answer, stream);
    for (const std::string& name : world_columns(answer)) {
        row.separate();
        row.text(name);
    }
    row.end();
    write_all_cells(answer, row, [&row] { row.end(); });
}

void write_world_npy(std::ostream& stream, const WorldAnswer& answer) {
    const std::size_t columns = world_columns(answer).size();
    std::vector<double> numbers;
    NumbersRow row(answer, numbers);
    write_all_cells(answer, row, [] {});
    write_npy(stream, std::span<const double>(numbers), static_cast<std::uint32_t>(columns),
              static_cast<std::uint32_t>(numbers.size() / columns));
}

}  // namespace nearfield::tools
