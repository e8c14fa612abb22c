#!/usr/bin/env bash
# No relative link of the installed documents is dead, and the check notices one that is.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

check="$SOURCE/tools/scripts/check_links.py"
"$check" "$prefix/share/doc/nearfield"

work="$place/documents"
mkdir "$work"
cat >"$work/page.md" <<'END'
# A page

## Size, `count` and state

[here](#size-count-and-state), [there](other.md#a-page), [a file](other.md), [a site](https://example.org)

```cpp
auto f = [x](missing);  // [code](missing.md)
```
END
printf '# A page\n' >"$work/other.md"
"$check" "$work"
# expect_dead LINK REASON: one link more, which the check names.
expect_dead() {
    local said
    printf '# Dead\n\nsee [this](%s)\n' "$1" >"$work/dead.md"
    ! said=$("$check" "$work") || fail "$1 was not noticed"
    [[ $said == "dead.md:3: $1: $2" ]] || fail "$1: $said"
    rm "$work/dead.md"
}
expect_dead missing.md 'no such file'
expect_dead ../missing/file.hpp 'no such file'
expect_dead page.md#missing 'no such heading'
expect_dead '#missing' 'no such heading'
