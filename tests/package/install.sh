#!/usr/bin/env bash
# Installs everything, moves it, and inspects it.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

place=$(mktemp --directory "${TMPDIR:-/tmp}/nearfield package.XXXXXX")
printf '%s' "$place" >"$PLACE"
prefix="$place/the prefix"
DESTDIR='' cmake --install "$BUILD" --prefix "$place/first prefix" >/dev/null
mv "$place/first prefix" "$prefix"

names_nothing_of_the_project "$prefix"
for file in bin/nearfield include/nearfield/nearfield.hpp 'lib*/libnearfield.a' 'lib*/libnearfield.so' \
    'lib*/pkgconfig/nearfield.pc' 'lib*/cmake/nearfield/nearfield-config-version.cmake' \
    'share/doc/nearfield/LICENSE' 'share/doc/nearfield/docs/how_it_works.md'; do
    [[ -n $(find "$prefix" -path "$prefix/$file") ]] || fail "$file is not installed"
done

version=$(sed -n 's/^#define NEARFIELD_VERSION "\(.*\)"/\1/p' "$prefix/include/nearfield/version.hpp")
says=$("$prefix/bin/nearfield" --version)
[[ $says == "nearfield $version" ]] || fail "the headers are of version $version; the tool says: $says"
