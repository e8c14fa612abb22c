#pragma once

namespace nearfield::geometry {

/// The subdivision of a quadtree: calls `use(column, row)` with the low corner of each quarter of a
/// square whose low corner is (column, row) and whose side is twice `half`; row by row.
template <class Index, class Use>
void for_quarters(Index column, Index row, Index half, const Use& use) {
    use(column, row);
    use(column + half, row);
    use(column, row + half);
    use(column + half, row + half);
}

}  // namespace nearfield::geometry
