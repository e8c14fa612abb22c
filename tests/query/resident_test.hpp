#pragma once

#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>
#include <tests/query/resident_reader.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

namespace nearfield::test {

/// What a query leaves on the device, and its result.
template <class Query>
struct Kept {
    using Output =
        std::decay_t<decltype(*std::declval<Context&>().on_device(Ticket(), QueryHandle<Query>()))>;
    using Contents = decltype(std::declval<ResidentReader&>().read(std::declval<Output&>()));

    Output output;
    Contents contents;
    typename Query::Result result;
};

/// Tests of resident outputs.
class Resident : public QueryTest {
protected:
    void SetUp() override { reader_ = std::make_unique<ResidentReader>(host_device()); }
    void TearDown() override {
        reader_.reset();
        QueryTest::TearDown();
    }

    [[nodiscard]] ResidentReader& reader() { return *reader_; }

    /// Submits a batch of one query and reads its resident output before it is collected.
    template <class Query, class Read>
    typename Query::Result ask(Context& context, const Query& query, Read&& read) {
        Batch batch;
        const auto handle = batch.add(query);
        Results results;
        const Expected<Ticket> ticket = context.submit(batch);
        EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
        if (ticket.has_value()) {
            const auto resident = context.on_device(*ticket, handle);
            EXPECT_TRUE(resident.has_value()) << resident.error().text();
            if (resident.has_value()) {
                read(*resident);
            }
            const Status status = context.collect(*ticket, results);
            EXPECT_TRUE(status.ok()) << status.text();
        }
        return results.results.empty() ? typename Query::Result() : results[handle];
    }

    template <class Output>
    auto contents_of(const Output& output) {
        return reader().read(output);
    }

    /// Asks, and keeps what stays, which is read before the result is collected.
    template <class Query>
    Kept<Query> keep(Context& context, Query query) {
        query.on_device = true;
        Kept<Query> kept;
        kept.result = ask(context, query, [&](const auto& output) {
            kept.output = output;
            kept.contents = contents_of(output);
        });
        return kept;
    }

private:
    std::unique_ptr<ResidentReader> reader_;
};

[[nodiscard]] double distance_between(const Vector2& a, const Vector2& b);

/// Different features may be reported only if both are equally near: at a vertex.
[[nodiscard]] bool same_place(const oracle::ShapeOracle& shape, const Feature& a, const Feature& b,
                              const Vector2& point, double allowed);

/// A field of part of the pair's B with both sides; it stays on the device.
[[nodiscard]] DistanceFieldQuery field_of(const PlacedPair& pair, Technique technique);
/// The resident output must equal the result that was read back.
void check_field(const PlacedPair& pair, const Kept<DistanceFieldQuery>& kept);

}  // namespace nearfield::test
