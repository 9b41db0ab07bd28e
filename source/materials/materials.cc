// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/materials.h>
#include <talus/points/points_kernel.h>

#include <deal.II/base/mpi.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  StrengthRange
  over_ranks(const StrengthRange &range, const MPI_Comm communicator)
  {
    return {Utilities::MPI::min(range.least, communicator),
            Utilities::MPI::max(range.largest, communicator)};
  }



  // The parameters of a section depend on its law, so names and laws must be
  // known before parameters are declared: a first, tolerant pass over the file
  // finds both (doc/architecture.md). Names and laws are declared here again
  // for the strict pass and for the documentation of the parameters.
  template <int dim>
  Materials<dim>::Materials(const std::vector<MaterialName> &names)
    : ParameterAcceptor("/Materials")
    , names_(names)
  {
    add_parameter("Names",
                  listed_names_,
                  "Names of the materials, separated by commas; each name has "
                  "a section.");
    const Patterns::Selection laws(
      boost::algorithm::join(material_names<dim>(), "|"));
    for (MaterialName &material : names_)
      {
        enter_subsection(material.name);
        add_parameter(
          "Law", material.law, "Constitutive law.", this->prm, laws);
        leave_subsection();
        models_.push_back(
          make_material<dim>(material.law, "/Materials/" + material.name));
      }
  }



  // Bodies of the same material share one object; each body keeps its own
  // points.
  template <int dim>
  void
  Materials<dim>::assign(const std::vector<std::string> &names_of_bodies,
                         const std::vector<std::string> &materials_of_bodies)
  {
    for (const auto &model : models_)
      model->check();
    std::string known;
    for (const MaterialName &material : names_)
      known += (known.empty() ? "" : ", ") + material.name;

    material_of_body_.clear();
    for (unsigned int b = 0; b < names_of_bodies.size(); ++b)
      {
        unsigned int m = 0;
        while (m < names_.size() && names_[m].name != materials_of_bodies[b])
          ++m;
        AssertThrow(m < names_.size(),
                    ExcUser(text("The body '",
                                 names_of_bodies[b],
                                 "' has the material '",
                                 materials_of_bodies[b],
                                 "', but Materials/Names lists only: ",
                                 known,
                                 ". Correct 'Bodies/",
                                 names_of_bodies[b],
                                 "/Material' or add the material.")));
        material_of_body_.push_back(m);
      }
  }



  template <int dim>
  std::vector<Remark>
  Materials<dim>::notes(const double cell_size) const
  {
    std::vector<Remark> result;
    const auto         &used = material_of_body_;
    for (unsigned int m = 0; m < models_.size(); ++m)
      if (std::find(used.begin(), used.end(), m) == used.end())
        result.emplace_back("no body is made of this material: look at "
                            "'Material' of the bodies, or remove the name from "
                            "'Materials/Names'.",
                            Severity::look,
                            "section " + models_[m]->section());
      else
        result.push_back(models_[m]->note(cell_size));
    return result;
  }



  // Laws share columns of the same name and kind (Points::add_column()), and
  // all points have all columns: a column costs eight bytes per point, but
  // points of all bodies stay in one sorted list.
  template <int dim>
  void
  Materials<dim>::add_columns(Points<dim> &points,
                              const bool   with_strength_factor)
  {
    for (const auto &model : models_)
      model->add_columns(points);
    if (are_undrained())
      points.add_pore_pressure();
    for (const auto &model : models_)
      {
        if (model->undrained_strength() != nullptr)
          undrained_strength_ = points.find("undrained shear strength");
        if (model->softens_by_displacement())
          cell_size_ = points.find("cell size");
      }
    if (!with_strength_factor)
      return;
    strength_factor_ =
      points.add_column("strength factor", "-", 1, Inheritance::copied);
    for (const auto &model : models_)
      model->use_strength_factor(strength_factor_);
  }



  template <int dim>
  bool
  Materials<dim>::are_undrained() const
  {
    return std::any_of(models_.begin(), models_.end(), [](const auto &model) {
      return model->pore_water().stiffness > 0.;
    });
  }



  template <int dim>
  void
  Materials<dim>::use_initial_pressure(const Points<dim> &points,
                                       const MPI_Comm     communicator)
  {
    std::vector<double> largest(models_.size(), 0.);
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        double &of_model =
          largest[material_of_body_[points.data(points.body)[p]]];
        of_model =
          std::max(of_model, -mean_normal(load_stress<dim, double>(points, p)));
      }
    for (unsigned int m = 0; m < models_.size(); ++m)
      if (const double of_all = Utilities::MPI::max(largest[m], communicator);
          of_all > 0.)
        models_[m]->use_initial_pressure(of_all);
  }



  template <int dim>
  double
  Materials<dim>::water_energy(const Points<dim> &points) const
  {
    const double *const u   = points.data(points.pore_pressure());
    double              sum = 0;
    for_each_material_range(points,
                            points.all(),
                            [&](const MaterialModel<dim> &model,
                                const unsigned int        begin,
                                const unsigned int        end) {
                              if (const double stiffness =
                                    model.pore_water().stiffness;
                                  stiffness > 0.)
                                for (unsigned int p = begin; p < end; ++p)
                                  sum +=
                                    volume_of_points<dim, double>(points, p) *
                                    u[p] * u[p] / (2. * stiffness);
                            });
    return sum;
  }



  template <int dim>
  StrengthRange
  Materials<dim>::strength_range(const Points<dim> &points,
                                 const unsigned int body,
                                 const MPI_Comm     communicator) const
  {
    if (of_body(body).undrained_strength() == nullptr)
      return {0., 0.};
    StrengthRange range;
    for (unsigned int p = 0; p < points.size(); ++p)
      if (points.data(points.body)[p] == body)
        range.include(points.data(undrained_strength_)[p]);
    return over_ranks(range, communicator);
  }



  // Only materials in use limit the search.
  template <int dim>
  double
  Materials<dim>::largest_strength_factor(const Points<dim> &points,
                                          const MPI_Comm     communicator) const
  {
    double result = std::numeric_limits<double>::infinity();
    for (unsigned int b = 0; b < material_of_body_.size(); ++b)
      result = std::min(result,
                        of_body(b).largest_strength_factor(
                          strength_range(points, b, communicator)));
    return result;
  }



  // One virtual call per range of points of a material, not per point: the loop
  // of the law has its formulas inlined.
  template <int dim>
  void
  Materials<dim>::update_stress(Points<dim>              &points,
                                const StepWorkspace<dim> &workspace,
                                const Batch              &batch,
                                const double              dt) const
  {
    for_each_material_range(
      points,
      batch,
      [&](const MaterialModel<dim> &model,
          const unsigned int        begin,
          const unsigned int        end) {
        model.update_stress(points, workspace, begin, end, dt);
        model.pore_water().advance(points, workspace, begin, end, dt);
      });
  }



  template class Materials<2>;
  template class Materials<3>;
} // namespace talus
