#include <tests/support/shader_accesses.hpp>

namespace nearfield::test_support {
namespace {

// SPIR-V specification, "Instructions" and "Decoration".
constexpr std::uint32_t header_words = 5;
constexpr std::uint32_t op_load = 61;
constexpr std::uint32_t op_store = 62;
constexpr std::uint32_t op_access_chain = 65;
constexpr std::uint32_t op_in_bounds_access_chain = 66;
constexpr std::uint32_t op_decorate = 71;
constexpr std::uint32_t op_atomic_load = 227;
constexpr std::uint32_t op_atomic_store = 228;
constexpr std::uint32_t op_atomic_xor = 242;  // the last of those that read and write
constexpr std::uint32_t decoration_binding = 33;

/// Calls visit(operation, operands) for each instruction.
template <class Visit>
void for_each_instruction(std::span<const std::uint32_t> code, const Visit& visit) {
    for (std::size_t i = header_words; i < code.size();) {
        const std::uint32_t words = code[i] >> 16U;
        visit(code[i] & 0xffffU, code.subspan(i + 1, words - 1));
        i += words;
    }
}

}  // namespace

std::map<std::uint32_t, ShaderAccess> buffer_accesses(std::span<const std::uint32_t> code) {
    std::map<std::uint32_t, std::uint32_t> binding_of;   // by variable
    std::map<std::uint32_t, std::uint32_t> variable_of;  // by pointer into it
    std::map<std::uint32_t, ShaderAccess> accesses;
    const auto access = [&](std::uint32_t pointer) -> ShaderAccess* {
        const auto into = variable_of.find(pointer);
        const auto bound = binding_of.find(into == variable_of.end() ? pointer : into->second);
        return bound == binding_of.end() ? nullptr : &accesses[bound->second];
    };
    const auto note = [&](std::uint32_t pointer, bool reads, bool writes) {
        if (ShaderAccess* const found = access(pointer)) {
            found->reads = found->reads || reads;
            found->writes = found->writes || writes;
        }
    };
    for_each_instruction(code, [&](std::uint32_t operation, std::span<const std::uint32_t> words) {
        if (operation == op_decorate && words[1] == decoration_binding) {
            binding_of[words[0]] = words[2];
        } else if (operation == op_access_chain || operation == op_in_bounds_access_chain) {
            const auto into = variable_of.find(words[2]);
            variable_of[words[1]] = into == variable_of.end() ? words[2] : into->second;
        } else if (operation == op_load || operation == op_atomic_load) {
            note(words[2], true, false);
        } else if (operation == op_store || operation == op_atomic_store) {
            note(words[0], false, true);
        } else if (operation > op_atomic_store && operation <= op_atomic_xor) {
            note(words[2], true, true);
        }
    });
    return accesses;
}

}  // namespace nearfield::test_support
