// OpenGL 3.3 core without a window, a display or a loader: OSMesa exports every function.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
#include <GL/glext.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tendril::render {

/// An off-screen context, current in this thread while it lives. Throws UsageError when OSMesa gives none.
class Context {
 public:
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

 private:
  OSMesaContext context_ = nullptr;
  std::vector<unsigned char> page_;
};

/// A linked program; `defines` stand before both sources.
class Program {
 public:
  Program(std::string_view vertex, std::string_view fragment, std::string_view defines = {});
  ~Program() { glDeleteProgram(program_); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { glUseProgram(program_); }
  GLint at(const char* uniform) const { return glGetUniformLocation(program_, uniform); }
  void set(const char* uniform, float x) const { glUniform1f(at(uniform), x); }
  void set(const char* uniform, float x, float y) const { glUniform2f(at(uniform), x, y); }
  void set(const char* uniform, float x, float y, float z) const { glUniform3f(at(uniform), x, y, z); }
  /// Binds a texture to a unit and names the unit to the sampler.
  void texture(const char* uniform, int unit, GLuint texture) const;

 private:
  GLuint program_;
};

class Texture {
 public:
  /// Clamped; nearest, linear, or linear with mipmaps that the caller generates.
  Texture(GLenum internal, int width, int height, GLenum format, GLenum type, const void* data = nullptr,
          GLenum filter = GL_NEAREST);
  ~Texture() { glDeleteTextures(1, &name); }
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  GLuint name = 0;
};

/// A target to draw into: textures of one size, the depth one may be missing (0).
class Target {
 public:
  Target(std::vector<GLuint> colours, GLuint depth, int width, int height);
  ~Target() { glDeleteFramebuffers(1, &name_); }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  void bind() const;

 private:
  GLuint name_ = 0;
  std::vector<GLenum> slots_;
  int width_, height_;
};

}  // namespace tendril::render
