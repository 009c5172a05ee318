#ifndef dmgTestReadPly_h
#define dmgTestReadPly_h

#include "Support/MeshFactory.h"

#include <string>

namespace dmg::test
{

/// Reads the PLY files of the benchmarks: binary little-endian, vertices float x y z, faces of
/// three int indices with a uchar count, nothing else. (The product reads files with VTK.)
/// \throw InvalidInput the file is missing or of another kind.
Surface ReadPly(const std::string& path);

}

#endif
