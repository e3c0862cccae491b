#include "commands/commands.h"

int main(int argc, char** argv) { return clothsim::runCommandLine(argc, argv); }
