// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/footprint.h>
#include <talus/simulation/contact_area_remark.h>

#include "../contact/soil_on_bed.h"

namespace contact_area_remark_test
{
  /// Soil from x = 0 to 3 m after a step of contact with a bed, @p height m
  /// below the soil.
  struct Areas : SoilOnBed<2>
  {
    explicit Areas(const double height)
    {
      time_step = 0.1;
      fill_boxes({0., 2. + height}, {3., 3.5 + height});
      move(Point<2>(0., -1.));
      contact.find_soil(*this);
      contact.correct_velocities(*this);
    }

    /// Write a row, and return the number of remarks.
    std::string
    observe()
    {
      row.clear();
      remark.list_quantities(*this, row);
      remark.observe(*this);
      return log.count_of_remarks();
    }

    Log                  log{MPI_COMM_WORLD};
    ContactAreaRemark<2> remark{boundaries, contact, log};
    Quantities           row; ///< contact area and footprint, m
  };
} // namespace contact_area_remark_test



// Facets whose nodes have soil: 3 m under the soil, and a little of the facet
// beside. For soil 0.3 m above the bed there is no contact, and no remark,
// since soil may start in the air.
TEST(ContactAreaRemark, AreasOfSoilOnAndAboveTheBed)
{
  using namespace contact_area_remark_test;
  for (const double height : {0., 0.3})
    {
      Areas soil(height);
      EXPECT_EQ(soil.observe(), "");
      ASSERT_EQ(soil.row.size(), 2u);
      EXPECT_NEAR(soil.row[0].value, height == 0. ? 3. : 0., 0.01);
      EXPECT_NEAR(soil.row[1].value, 3., 1e-12);
      Quantities again;
      list_contact_area(soil, soil.boundaries, soil.contact, again);
      for (const unsigned int i : {0, 1})
        {
          EXPECT_EQ(soil.row[i].name, again[i].name);
          EXPECT_EQ(soil.row[i].value, again[i].value);
        }
    }
}



// The upper boxes are moved over further 3 m of ground, without contact there.
TEST(ContactAreaRemark, SoilInTheAirIsRemarkedOnce)
{
  using namespace contact_area_remark_test;
  Areas soil(0.);
  EXPECT_EQ(soil.observe(), "");
  for (unsigned int p = 0; p < soil.points.size(); ++p)
    if (soil.get(soil.points.position, p)[1] > 3.)
      soil.points.data(soil.points.position)[p] += 3.;
  soil.sort();
  EXPECT_EQ(soil.observe(), "1 remark");
  EXPECT_NEAR(soil.row[1].value, 6., 1e-12);
  EXPECT_EQ(soil.observe(), "1 remark");
}
