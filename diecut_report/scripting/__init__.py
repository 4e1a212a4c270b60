"""The program as scripts and notebooks use it: ``import diecut_report as dr; dr.load("press.yaml").calculate()``.

Machines are loaded (`loading`), changed, calculated, swept and asked (`loaded_press`); what comes out are quantities with units (`values`),
checks, curves and figures of each mechanism (`results`, `mechanism_results`), and tables of many machines (`sweeps`). Whatever a script
gives that is wrong is a ConfigError in the words of the command line.
"""
