#pragma once

#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>
#include <tests/query/resident_reader.hpp>

#include <array>
#include <cstdint>
#include <memory>

namespace nearfield::test {

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

    FieldContents contents_of(const FieldOnDevice& field) { return reader().read(field); }
    RecordsContents contents_of(const PointsOnDevice& records) { return reader().read(records); }
    SamplesContents contents_of(const SamplesOnDevice& samples) { return reader().read(samples); }

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
void check_field(const PlacedPair& pair, const FieldOnDevice& field, const FieldContents& contents,
                 const DistanceFieldResult& result);

}  // namespace nearfield::test
