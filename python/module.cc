// SPDX-License-Identifier: LGPL-2.1-or-later
// The compiled part of the Python module talus. share/talus/talus/run.py
// derives from the class Run here, and describes the functions for users.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <talus/application/message.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <new>

#include "led_run.h"
#include "mpi_of_module.h"

namespace
{
  using namespace talus;
  namespace py = pybind11;

  /// Turn errors of talus into talus.Error with the same sentence.
  void
  translate(std::exception_ptr error)
  {
    try
      {
        if (error)
          std::rethrow_exception(error);
      }
    catch (const dealii::ExceptionBase &exception)
      {
        const py::object type =
          py::module_::import("talus_tools.errors").attr("UserError");
        PyErr_SetString(type.ptr(), message(exception).c_str());
      }
    catch (const std::bad_alloc &exception)
      {
        PyErr_SetString(PyExc_MemoryError, message(exception).c_str());
      }
  }



  /// Return a read-only array, shape (components of the value, points), that
  /// shares the memory of the points and keeps it.
  py::array
  as_array(const PointColumn &column)
  {
    const py::ssize_t        size = sizeof(double);
    std::vector<py::ssize_t> shape(column.shape.begin(), column.shape.end());
    shape.push_back(column.n_points);
    std::vector<py::ssize_t> strides(shape.size(), size);
    py::ssize_t              stride = size * column.pitch;
    for (unsigned int i = column.shape.size(); i-- > 0;)
      {
        strides[i] = stride;
        stride *= shape[i];
      }
    using Owner = std::shared_ptr<const double>;
    const py::capsule   owner(new Owner(column.owner), [](void *pointer) {
      delete static_cast<Owner *>(pointer);
    });
    py::array_t<double> result(shape, strides, column.data, owner);
    result.attr("setflags")(py::arg("write") = false);
    return result;
  }



  py::array
  column(const python::LedRun &led, const std::string &name)
  {
    for (const PointColumn &column : led.use(&Run::point_columns))
      if (column.name == name)
        return as_array(column);
    throw py::key_error(name);
  }



  py::list
  columns(const python::LedRun &led)
  {
    py::list result;
    for (const PointColumn &column : led.use(&Run::point_columns))
      result.append(py::make_tuple(column.name, column.unit));
    return result;
  }



  py::dict
  as_dict(const Quantities &quantities)
  {
    py::dict result;
    for (const Quantity &quantity : quantities)
      result[py::str(quantity.heading())] = quantity.value;
    return result;
  }



  void
  add_obstacle(py::module_ &module)
  {
    const auto as_array = [](std::vector<double> ObstacleState::*member) {
      return [member](const ObstacleState &obstacle) {
        const std::vector<double> &values = obstacle.*member;
        return py::array_t<double>(values.size(), values.data());
      };
    };
    py::class_<ObstacleState>(module, "Obstacle")
      .def_readonly("name", &ObstacleState::name)
      .def_readonly("contact_area", &ObstacleState::contact_area)
      .def_property_readonly("displacement",
                             as_array(&ObstacleState::displacement))
      .def_property_readonly("velocity", as_array(&ObstacleState::velocity))
      .def_property_readonly("force", as_array(&ObstacleState::force))
      .def_property_readonly("moment", as_array(&ObstacleState::moment))
      .def_property_readonly("impulse", as_array(&ObstacleState::impulse));
  }
} // namespace



PYBIND11_MODULE(_talus, module)
{
  using dealii::Utilities::MPI::n_mpi_processes;
  using dealii::Utilities::MPI::this_mpi_process;
  using python::LedRun;
  const auto get = [](const auto member) {
    return [member](const LedRun &led) { return led.use(member); };
  };
  const auto on_ranks = [](const auto function) {
    return [function](const LedRun &led) {
      return function(led.use(&Run::communicator));
    };
  };
  python::begin_mpi();
  py::register_exception_translator(&translate);
  add_obstacle(module);
  py::class_<LedRun>(module, "Run")
    .def(py::init<const std::string &,
                  bool,
                  const std::vector<std::string> &,
                  const RunOptions &,
                  const py::object &>())
    .def("_advance_to", &LedRun::advance_to)
    .def("_write_checkpoint", &LedRun::write_checkpoint)
    .def("_column", &column)
    .def("_columns", &columns)
    .def("_statistics", [](LedRun &led) { return as_dict(led.statistics()); })
    .def("_accounts", [](LedRun &led) { return as_dict(led.accounts()); })
    .def("_obstacles", get(&Run::obstacles))
    .def("stop", get(&Run::stop))
    .def("close", &LedRun::close)
    .def_property_readonly("dimension", get(&Run::dimension))
    .def_property_readonly("time", get(&Run::time))
    .def_property_readonly("end_time", get(&Run::end_time))
    .def_property_readonly("time_step", get(&Run::time_step))
    .def_property_readonly("n_steps", get(&Run::n_steps))
    .def_property_readonly("is_finished", get(&Run::is_finished))
    .def_property_readonly("folder", get(&Run::output_folder))
    .def_property_readonly("rank", on_ranks(&this_mpi_process))
    .def_property_readonly("n_ranks", on_ranks(&n_mpi_processes));
  py::class_<RunOptions>(module, "Options")
    .def(py::init<>())
    .def_readwrite("output_folder", &RunOptions::output_folder)
    .def_readwrite("resume", &RunOptions::resume)
    .def_readwrite("overwrite", &RunOptions::overwrite)
    .def("prescribe_velocity", &python::prescribe_velocity);
  py::module_::import("atexit").attr("register")(
    py::cpp_function(&python::end_mpi));
}
