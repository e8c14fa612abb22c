#!/usr/bin/env bash
# Shaders include the installed declarations, GLSL and HLSL, which lay out all structures alike.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

work="$place/shaders"
mkdir "$work"
cat >"$work/reads.comp" <<'END'
#version 450
#extension GL_GOOGLE_include_directive : require
#include "nearfield/nearfield.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer B0 { NearfieldHeader headers[]; };
layout(std430, binding = 1) readonly buffer B1 { NearfieldSummary summaries[]; };
layout(std430, binding = 2) readonly buffer B2 { NearfieldPoint points[]; };
layout(std430, binding = 3) readonly buffer B3 { NearfieldIntersectionSummary overlaps[]; };
layout(std430, binding = 4) readonly buffer B4 { NearfieldIntersectionSample samples[]; };
layout(std430, binding = 5) readonly buffer B5 { NearfieldPair pairs[]; };
layout(std430, binding = 6) writeonly buffer B6 { float sums[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    sums[i] = nearfield_depth(points[i]) + summaries[0].depth + overlaps[0].area +
              samples[i].position.x + pairs[i].depth + float(headers[0].count);
}
END
cat >"$work/apart.frag" <<'END'
#version 450
#extension GL_GOOGLE_include_directive : require
#include "nearfield/nearfield.glsl"
layout(binding = 0) uniform sampler2D combined;
layout(binding = 1) uniform texture2D field;
layout(binding = 2) uniform sampler any_sampler;
layout(location = 0) out vec2 distances;
void main() {
    vec2 texel = nearfield_texel(gl_FragCoord.xy, vec2(0.0), 0.5);
    distances = vec2(nearfield_signed_distance(combined, ivec2(64), texel),
                     nearfield_signed_distance(field, any_sampler, ivec2(64), texel));
}
END
cat >"$work/reads.hlsl" <<'END'
#include "nearfield/nearfield.hlsl"
StructuredBuffer<NearfieldHeader> headers : register(t0);
StructuredBuffer<NearfieldSummary> summaries : register(t1);
StructuredBuffer<NearfieldPoint> points : register(t2);
StructuredBuffer<NearfieldIntersectionSummary> overlaps : register(t3);
StructuredBuffer<NearfieldIntersectionSample> samples : register(t4);
StructuredBuffer<NearfieldPair> pairs : register(t5);
RWStructuredBuffer<float> sums : register(u6);
Texture2D<float> field : register(t7);
[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    sums[id.x] = nearfield_depth(points[id.x]) + summaries[0].depth + overlaps[0].area +
                 samples[id.x].position.x + pairs[id.x].depth + float(headers[0].count) +
                 nearfield_signed_distance(field, int2(64, 64),
                                           nearfield_texel(points[id.x].position, 0.0, 0.5));
}
END

# Combined image samplers, and textures and samplers that are bound apart.
"$GLSLANG" -V "-I$prefix/include" -o "$work/apart.spv" "$work/apart.frag" >"$work/apart.txt" ||
    fail "apart.frag does not compile: $(<"$work/apart.txt")"

# layout_of FILE OPTION...: the offset of each member of nearfield's structures.
layout_of() {
    "$GLSLANG" -V "-I$prefix/include" -H -o "$work/words" "${@:2}" "$work/$1" >"$work/$1.txt" ||
        fail "$1 does not compile: $(<"$work/$1.txt")"
    sed -n 's/^ *MemberDecorate [0-9]*(\(Nearfield[A-Za-z]*\)) \([0-9]*\) *Offset \([0-9]*\)$/\1 \2 \3/p' \
        "$work/$1.txt" | sort --unique
}

glsl=$(layout_of reads.comp)
hlsl=$(layout_of reads.hlsl -D -S comp -e main)
[[ $(wc -l <<<"$glsl") == 39 ]] || fail "GLSL has other members: $glsl"
[[ $glsl == "$hlsl" ]] || fail "the layouts differ: $(diff <(echo "$glsl") <(echo "$hlsl"))"
printf '%s members\n' "$(wc -l <<<"$glsl")"
