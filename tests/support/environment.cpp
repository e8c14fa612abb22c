#include "environment.hpp"

#include <cstdlib>
#include <utility>

namespace nearfield::test_support {

Environment::Environment(std::string name, const std::string& value) : name_(std::move(name)) {
    if (const char* const former = std::getenv(name_.c_str())) {
        former_ = former;
    }
    setenv(name_.c_str(), value.c_str(), 1);
}

Environment::~Environment() {
    if (former_) {
        setenv(name_.c_str(), former_->c_str(), 1);
    } else {
        unsetenv(name_.c_str());
    }
}

}  // namespace nearfield::test_support
