#include <tribodraw/application/program.h>

int main(int argc, char **argv) { return tribodraw::run_program(argc, argv); }
