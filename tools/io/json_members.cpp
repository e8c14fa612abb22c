#include <tools/io/json_members.hpp>
#include <tools/io/values.hpp>

#include <cmath>
#include <filesystem>

namespace nearfield::tools {

void require_known_members(const JsonPlace& place, const std::vector<std::string_view>& known) {
    for (const auto& [key, value] : place.require_object().value().items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            throw UnknownMember(place.member(key).text() + ": is not known here");
        }
    }
}

std::vector<double> numbers(const JsonPlace& place, std::size_t count, const std::string& form) {
    if (place.require_array().value().size() != count) {
        place.fail("expected " + form);
    }
    std::vector<double> numbers;
    for (std::size_t index = 0; index < count; ++index) {
        numbers.push_back(place.element(index).number());
    }
    return numbers;
}

double read_above_zero(const JsonPlace& place) {
    const double number = place.number();
    if (!(number > 0.0)) {
        place.fail("expected a number greater than 0");
    }
    return number;
}

std::uint32_t read_count(const JsonPlace& place) {
    const double number = place.number();
    if (!(number >= 1.0 && number <= 1e9 && number == std::floor(number))) {
        place.fail("expected a whole number from 1 to 1000000000");
    }
    return static_cast<std::uint32_t>(number);
}

Rectangle read_rectangle(const JsonPlace& place) {
    const std::vector<double> corners = numbers(place, 4, "[x0, y0, x1, y1] (four numbers)");
    if (!(corners[0] < corners[2] && corners[1] < corners[3])) {
        place.fail("expected x0 < x1 and y0 < y1");
    }
    return {{corners[0], corners[1]}, {corners[2], corners[3]}};
}

std::string read_path(const JsonPlace& name) {
    const std::filesystem::path folder = std::filesystem::path(name.file()).parent_path();
    return (folder / name.string()).string();
}

void require_angle(const JsonPlace& pose, double degrees) {
    if (const std::string problem = angle_problem(degrees); !problem.empty()) {
        pose.fail(problem);
    }
}

bool append_row(const nlohmann::json& row, std::size_t columns, std::vector<double>& numbers) {
    if (!row.is_array() || row.size() != columns) {
        return false;
    }
    for (const nlohmann::json& number : row) {
        if (!number.is_number()) {
            return false;
        }
        numbers.push_back(number.get<double>());
        if (!std::isfinite(numbers.back())) {
            return false;
        }
    }
    return true;
}

NumberTable read_rows(const JsonPlace& place, std::size_t columns, const std::string& form) {
    NumberTable table{.numbers = {}, .columns = columns};
    const nlohmann::json& rows = place.require_array().value();
    table.numbers.reserve(rows.size() * columns);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!append_row(rows[i], columns, table.numbers)) {
            static_cast<void>(numbers(place.element(i), columns, form));  // says what is wrong
        }
    }
    return table;
}

}  // namespace nearfield::tools
