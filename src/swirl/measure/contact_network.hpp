// Which discs touch which: the statistics of the network of contacts.
//
//   coordination   touching discs of a disc, 2 × pairs / N
//   wall           share of the discs that touch the wall
//   isolated       share of the discs that touch nothing
//   rattlers       share of the discs with fewer than two contacts, the wall counted: friction
//                  needs two contacts to hold a disc
//   groups         connected groups of discs per disc, (number of groups)/N: 1 if no discs touch.
//                  The wall connects no discs
//   largest        share of the discs that belong to the largest group
//   loops          independent loops per disc, (pairs − N + groups)/N: 0 for chains
//
// The table gives the share of the discs with 0, 1, 2, … touching discs.
//
// Touching: gap below 0.1 of the mean radius (touching_pairs.hpp), since hard discs touch only for
// an instant. In two dimensions equal discs have up to 6 contacts; loops reach 2 in a perfect
// hexagonal packing. By default only every 64th sample is used. Units: none. Errors: from blocks of
// periods. Limits: no discs: NaN. All numbers depend on the gap that counts as a contact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "swirl/measure/cell_averages.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/strided.hpp"
#include "swirl/measure/touching_pairs.hpp"

namespace swirl {

class ContactNetwork : public BlockAverages<ContactNetwork>, public Strided {
  public:
    static constexpr bool any_path = true;  // no axis of the M-frame matters
    static auto averages(auto& s) {
        return std::tie(s.coordination_, s.wall_, s.isolated_, s.rattlers_, s.groups_, s.largest_,
                        s.loops_, s.contacts_);
    }
    /// More contacts, which only mixtures have, are counted here.
    static constexpr std::size_t max_contacts = 12;

    explicit ContactNetwork(double gap = 0.1, int every = 64) : Strided(every), gap_(gap) {}

    void sample(const MFrameView& view);

    /// Share of the discs with this number of touching discs.
    Estimate share(std::size_t contacts) const { return contacts_.estimate(contacts); }

    template <class Visitor>
    void report(Visitor&& visit) const {
        const auto row = [&](const Quantity& its_quantity, const BlockMean& average) {
            visit(ReportRow{its_quantity, average.estimate()});
        };
        row(quantity("contact_network.coordination"), coordination_);
        row(quantity("contact_network.wall"), wall_);
        row(quantity("contact_network.isolated"), isolated_);
        row(quantity("contact_network.rattlers"), rattlers_);
        row(quantity("contact_network.groups"), groups_);
        row(quantity("contact_network.largest"), largest_);
        row(quantity("contact_network.loops"), loops_);
        ReportTable table{"contacts",
                          "share of the discs with a number of touching discs",
                          {{quantity("contact_network.contacts.contacts")},
                           {quantity("contact_network.contacts.share"), with_error_column}}};
        for (std::size_t k = 0; k < contacts_.size(); ++k)
            table.add(static_cast<double>(k), share(k));
        visit(std::move(table));
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_);
        this->visit_averages(visit);
    }

  private:
    std::uint32_t root_of(std::uint32_t disc);

    double gap_;
    BlockMean coordination_, wall_, isolated_, rattlers_, groups_, largest_, loops_;
    CellRates contacts_{max_contacts + 1};
    TouchingPairs touching_;
    std::vector<std::uint32_t> parent_;         // union-find: a disc of the same group
    std::vector<std::uint32_t> degree_, size_;  // touching discs of a disc; discs of a group
};

}  // namespace swirl
