#include "tetgen_shim.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include <tetgen.h>

#include "watch.h"
#include "result.h"

namespace {

// Exit status of a child that could not even begin.
const int CANNOT_BEGIN = 125;

// Exit status of a child that did not survive that its memory is limited, or that has no room left to
// say how it ended.
const int OUT_OF_MEMORY = 124;

// Copies the input into the structures TetGen frees with delete[].
void fill(tetgenio &io, const tetgen_shim_input &in) {
  io.firstnumber = 0;
  io.numberofpoints = in.point_count;
  io.pointlist = new REAL[size_t(in.point_count) * 3];
  memcpy(io.pointlist, in.points, size_t(in.point_count) * 3 * sizeof(REAL));
  io.facetmarkerlist = new int[in.triangle_count];
  memcpy(io.facetmarkerlist, in.markers, size_t(in.triangle_count) * sizeof(int));
  io.facetlist = new tetgenio::facet[in.triangle_count];
  io.numberoffacets = in.triangle_count;
  for (int32_t i = 0; i < in.triangle_count; i++) {
    tetgenio::facet &facet = io.facetlist[i];
    tetgenio::init(&facet);
    facet.polygonlist = new tetgenio::polygon[1];
    facet.numberofpolygons = 1;
    tetgenio::polygon &polygon = facet.polygonlist[0];
    polygon.vertexlist = new int[3];
    polygon.numberofvertices = 3;
    memcpy(polygon.vertexlist, in.triangles + size_t(i) * 3, 3 * sizeof(int));
  }
  if (in.hole_count > 0) {
    io.numberofholes = in.hole_count;
    io.holelist = new REAL[size_t(in.hole_count) * 3];
    memcpy(io.holelist, in.holes, size_t(in.hole_count) * 3 * sizeof(REAL));
  }
  if (in.region_count > 0) {
    io.numberofregions = in.region_count;
    io.regionlist = new REAL[size_t(in.region_count) * 5];
    memcpy(io.regionlist, in.regions, size_t(in.region_count) * 5 * sizeof(REAL));
  }
}

// Where the child finds the memory file.
const int RESULT = 3;

[[noreturn]] void finish(int64_t code, const tetgenio *output) {
  fflush(stdout);
  const bool written = write_result(RESULT, code, output) ||
                       write_result(RESULT, TETGEN_SHIM_NO_SPACE, nullptr);
  _exit(written ? 0 : OUT_OF_MEMORY);
}

// Runs when an exception finds no handler, before any destructor.
[[noreturn]] void report_exception() {
  int64_t code = TETGEN_SHIM_UNKNOWN_EXCEPTION;
  try {
    throw;
  } catch (int thrown) {
    code = thrown != 0 ? thrown : TETGEN_SHIM_ENDED;
  } catch (const std::bad_alloc &) {
    code = 1; // TetGen's own code for this
  } catch (...) {
  }
  finish(code, nullptr);
}

// Meshes and writes the result. Exceptions are not caught here on purpose: unwinding would destroy
// TetGen's half-built mesh, whose destructor crashes in version 1.5.0. On the bottom of a thread's
// stack they go to `report_exception` instead, with the stack as it was.
void *mesh(void *argument) {
  const tetgen_shim_input &in = *static_cast<const tetgen_shim_input *>(argument);
  // Nothing is freed: the process ends, and the kernel is faster.
  tetgenio *input = new tetgenio;
  tetgenio *output = new tetgenio;
  tetgenbehavior *behavior = new tetgenbehavior;
  char *switches = strdup(in.switches);
  // TetGen copies them without looking at their length.
  if (switches == nullptr || strlen(switches) >= sizeof behavior->commandline || !behavior->parse_commandline(switches)) {
    finish(TETGEN_SHIM_BAD_SWITCHES, nullptr);
  }
  // Switches that write files into the working directory.
  behavior->vtkview = 0;
  behavior->meditview = 0;
  behavior->voroout = 0;
  fill(*input, in);
  watch(in, *input);
  tetrahedralize(behavior, input, output, nullptr, nullptr);
  finish(output->numberofcorners == 4 ? 0 : TETGEN_SHIM_NOT_LINEAR, output);
}

// Size of the stack of the thread that meshes, unless the system refuses it.
constexpr size_t STACK = size_t(256) << 20;

// Runs `mesh` on a thread of its own, with a stack that deep recursion does not exhaust; only pages
// in use take memory.
void run(const tetgen_shim_input &in) {
  std::set_terminate(report_exception);
  pthread_attr_t attributes;
  pthread_t thread;
  void *argument = const_cast<tetgen_shim_input *>(&in);
  if (pthread_attr_init(&attributes) != 0 || pthread_attr_setstacksize(&attributes, STACK) != 0) {
    return;
  }
  if (pthread_create(&thread, &attributes, mesh, argument) != 0 &&
      pthread_create(&thread, nullptr, mesh, argument) != 0) {
    finish(1, nullptr);
  }
  pthread_join(thread, nullptr);
}

// Bytes that must be left for a crash not to be put down to the limit on memory.
size_t left_at_least = 0;

// Tells a crash for want of memory, which TetGen does not check everywhere, from others.
void crashed(int signal_number) {
  const void *room = mmap(nullptr, left_at_least, PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) {
    _exit(OUT_OF_MEMORY);
  }
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

// Lets this process allocate so many bytes beyond what the fork gave it and the stack.
bool limit_memory(uint64_t bytes) {
  if (bytes == 0) {
    return true;
  }
  unsigned long long pages = 0;
  FILE *sizes = fopen("/proc/self/statm", "r");
  const bool known = sizes != nullptr && fscanf(sizes, "%*u %*u %*u %*u %*u %llu", &pages) == 1;
  if (sizes != nullptr) {
    fclose(sizes);
  }
  const rlim_t most = pages * sysconf(_SC_PAGESIZE) + STACK + bytes;
  const struct rlimit limit = {most, most};
  // TetGen asks for pieces of up to a megabyte, and for more as its lists grow.
  left_at_least = bytes / 8 + (size_t(4) << 20);
  return known && setrlimit(RLIMIT_DATA, &limit) == 0 && signal(SIGSEGV, crashed) != SIG_ERR &&
         signal(SIGABRT, crashed) != SIG_ERR;
}

// Turns the forked copy of our process into one that only has what the mesher needs.
bool enter_child(pid_t parent, int result, int chatter) {
  // Die with the parent; it may have died before this took effect.
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent) {
    return false;
  }
  // Crashes must look like crashes, not run handlers of the parent.
  const int handled[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGPIPE};
  for (const int signal_number : handled) {
    signal(signal_number, SIG_DFL);
  }
  // What the parent was started to ignore, as by nohup, is ignored here too.
  const int requests[] = {SIGTERM, SIGINT, SIGHUP};
  for (const int signal_number : requests) {
    struct sigaction now;
    if (sigaction(signal_number, nullptr, &now) != 0 || now.sa_handler != SIG_IGN) {
      signal(signal_number, SIG_DFL);
    }
  }
  // A result that is too large fails to be written, and that is said.
  signal(SIGXFSZ, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const struct rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  // When memory runs out, this process is the one to go.
  const int score = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (score >= 0) {
    if (write(score, "900", 3) != 3) {
      // Only a preference.
    }
    close(score);
  }
  const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (null < 0 || dup2(chatter, 1) < 0 || dup2(chatter, 2) < 0 || dup2(null, 0) < 0) {
    return false;
  }
  if (result != RESULT && dup2(result, RESULT) < 0) {
    return false;
  }
  // The pipes of our process must not stay open on account of the mesher.
  closefrom(RESULT + 1);
  // Line by line, so that what was said before a crash is there.
  setvbuf(stdout, nullptr, _IOLBF, 0);
  return true;
}

} // namespace

extern "C" int32_t tetgen_shim_start(const tetgen_shim_input *input, int result, int chatter) {
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child != 0) {
    return child;
  }
  if (enter_child(parent, result, chatter) && limit_memory(input->memory)) {
    run(*input);
  }
  _exit(CANNOT_BEGIN);
}
