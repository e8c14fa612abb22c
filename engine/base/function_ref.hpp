#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace nearfield {

/// A function of the caller's, which has to stay for as long as this is called: what takes one is
/// no template, and nothing is allocated or copied.
template <class Signature>
class FunctionRef;

template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
public:
    template <class Function,
              class = std::enable_if_t<!std::is_same_v<std::remove_cvref_t<Function>, FunctionRef>>>
    FunctionRef(Function&& function) noexcept
        : function_(const_cast<void*>(static_cast<const void*>(std::addressof(function)))),
          call_([](void* of, Arguments... arguments) -> Result {
              return (*static_cast<std::remove_reference_t<Function>*>(of))(
                  std::forward<Arguments>(arguments)...);
          }) {}

    Result operator()(Arguments... arguments) const {
        return call_(function_, std::forward<Arguments>(arguments)...);
    }

private:
    void* function_;
    Result (*call_)(void* of, Arguments... arguments);
};

}  // namespace nearfield
