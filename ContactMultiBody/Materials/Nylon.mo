within ContactMultiBody.Materials;
record Nylon "Nylon on nylon"
  extends Material(
    E=2.8e9,
    nu=0.4,
    restitution=0.6,
    muStatic=0.25,
    muDynamic=0.2,
    density=1100);
  annotation (Documentation(info="<html>
<p>Elasticity and density: J. M. Gere, B. J. Goodno: Mechanics of Materials, 7th edition, Cengage 2009, appendix H, middle of the range of the modulus, upper end of the density. Friction, nylon on nylon: F. P. Bowden, D. Tabor: The Friction and Lubrication of Solids, Clarendon Press 1950 and 1964 (0.15 to 0.25). The coefficient of restitution is a typical value for impacts of about 1 m/s and depends on shape, speed and hardness; measure it where it matters.</p>
</html>"));
end Nylon;
