// The program that debugger.sh inspects.
#include <nearfield/context.hpp>

namespace {

void look(const nearfield::Vector2& vector, const nearfield::ShapeHandle& none,
          const nearfield::ShapeHandle& shape,
          const nearfield::QueryHandle<nearfield::ContactQuery>& query,
          const nearfield::Ticket& ticket, const nearfield::Feature& feature,
          const nearfield::Status& success, const nearfield::Status& error,
          const nearfield::Expected<nearfield::ShapeHandle>& value,
          const nearfield::Expected<nearfield::ShapeHandle>& no_value) {
    asm volatile("" ::"r"(&vector), "r"(&none), "r"(&shape), "r"(&query), "r"(&ticket));
    asm volatile("" ::"r"(&feature), "r"(&success), "r"(&error), "r"(&value), "r"(&no_value));
}

}  // namespace

int main() {
    const nearfield::Status error(nearfield::StatusCode::unsupported_device, "no such device",
                                  {"no queue", "no memory"});
    const nearfield::ShapeHandle shape{7, 2};
    look({1.5, -2.0}, {}, shape, {3}, {9}, {nearfield::Feature::Kind::vertex, 4}, {}, error,
         {shape}, {error});
    return 0;
}
