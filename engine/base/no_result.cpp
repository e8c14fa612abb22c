#include <nearfield/result.hpp>

namespace nearfield {

Status Results::status_of(NoResult fault) noexcept {
    try {
        switch (fault) {
            case NoResult::other_batch:
                return {StatusCode::invalid_query,
                        "a handle names no query of these results: it is of another batch, or of "
                        "the same one before it was cleared"};
            case NoResult::out_of_range:
                return {StatusCode::invalid_query,
                        "a handle names no query of these results: its position is out of range"};
            case NoResult::other_kind:
                return {StatusCode::invalid_query,
                        "a handle names no query of these results: the query at its position is of "
                        "another kind"};
        }
    } catch (...) {  // no memory for the words
    }
    return Status(StatusCode::invalid_query);
}

}  // namespace nearfield
