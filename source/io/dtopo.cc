// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/files.h>
#include <talus/io/surface_motion.h>

#include <limits>

namespace talus
{
  // The header has the value first; GeoClaw ignores the label. Every number is
  // written with the digits that give it back bit by bit.
  void
  write_dtopo(const std::filesystem::path &file, const SurfaceMotion &motion)
  {
    const Raster &frame = motion.frame;
    write_file(file, [&](std::ostream &out) {
      out.precision(std::numeric_limits<double>::max_digits10);
      out << frame.n_columns << " mx\n"
          << frame.n_rows << " my\n"
          << motion.n_blocks << " mt\n"
          << frame.x(0) << " xlower\n"
          << frame.y(frame.n_rows - 1) << " ylower\n"
          << motion.start_time << " t0\n"
          << frame.dx << " dx\n"
          << frame.dy << " dy\n"
          << motion.interval << " dt\n";
      for (unsigned int block = 0; block < motion.n_blocks; ++block)
        {
          const std::vector<double> values = motion.change(block);
          for (std::size_t i = 0; i < values.size(); ++i)
            out << values[i] << ((i + 1) % frame.n_columns == 0 ? '\n' : ' ');
        }
    });
  }
} // namespace talus
