#pragma once

#include <tools/io/input_error.hpp>

#include <string>

namespace nearfield::tools {

/// The text of the InputError that a call throws; "no error" if it throws none.
template <class Call>
std::string input_error(Call call) {
    try {
        static_cast<void>(call());
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace nearfield::tools
