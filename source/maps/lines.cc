// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/maps/lines.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  Lines<dim>::check(const State<dim> &state) const
  {
    const Box<dim> domain = state.grid.domain_before_growth();
    const double   width  = list_->width(state.grid.cell_size());
    this->settings().check(domain.length(1));
    double n = 0;
    for (const auto &line : list_->lines(domain, this->problem().origin()))
      for (unsigned int i = 1; i < line.corners.size(); ++i)
        n += line.corners[i].distance(line.corners[i - 1]) / width;
    AssertThrow(n <= 1e7,
                ExcUser(text("'Stations/Lines' would have ",
                             n,
                             " places, each a 'Stations/Width' of ",
                             width,
                             " m from the next. Make 'Stations/Width' "
                             "larger.")));
  }



  /// Each leg from corner to corner has places at the ends, and further places
  /// at equal distances between the ends.
  template <int dim>
  std::vector<typename Lines<dim>::Place>
  Lines<dim>::places(const State<dim> &state) const
  {
    const double       width = list_->width(state.grid.cell_size());
    std::vector<Place> result;
    for (const auto &line : list_->lines(state.grid.domain_before_growth(),
                                         this->problem().origin()))
      {
        result.push_back({line.name, 0., line.corners[0]});
        for (unsigned int i = 1; i < line.corners.size(); ++i)
          {
            const Tensor<1, dim> leg   = line.corners[i] - line.corners[i - 1];
            const double         n     = std::ceil(leg.norm() / width - 1e-9);
            const double         begin = result.back().distance;
            for (double j = 1; j <= n; ++j)
              result.push_back({line.name,
                                begin + j / n * leg.norm(),
                                line.corners[i - 1] + j / n * leg});
          }
      }
    return result;
  }



  template <int dim>
  std::shared_ptr<const PlanColumns<dim>>
  Lines<dim>::make_columns(const State<dim> &state) const
  {
    std::vector<Point<dim>> centres;
    for (const Place &place : places(state))
      centres.push_back(place.x);
    return std::make_shared<SquareColumns<dim>>(
      centres, list_->width(state.grid.cell_size()));
  }



  template <int dim>
  void
  Lines<dim>::write_files(const State<dim> &state)
  {
    const Envelope<dim> &envelope = this->envelope();
    auto fields = history_fields(envelope.settings().arrival_thresholds);
    if (impact().is_used())
      fields.push_back(
        {"maximum impact pressure", "Pa", [](const ColumnHistory &history) {
           return history.impact_pressure.value;
         }});
    write_file(this->path_of_output(file_name), [&](std::ostream &out) {
      out.precision(16);
      out << "line,distance [m],x [m]" << (dim == 3 ? ",z [m]" : "");
      for (const HistoryField &field : fields)
        out << ',' << field.name << " [" << field.unit << ']';
      out << '\n';
      unsigned int column = 0;
      for (const Place &place : places(state))
        {
          out << place.line << ',' << place.distance << ',' << place.x[0];
          if (dim == 3)
            out << ',' << place.x[dim - 1];
          for (const HistoryField &field : fields)
            out << ',' << csv_field(field.value(envelope[column]));
          out << '\n';
          ++column;
        }
    });
  }



  template class Lines<2>;
  template class Lines<3>;
} // namespace talus
